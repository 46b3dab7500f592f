#include "cell/silence_watch.hpp"

#include <algorithm>

#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "cell/schedule.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

SilenceWatch::SilenceWatch(const ResultsReader& results, std::size_t partition, CellController& controller)
    : controller_(controller),
      partition_(partition),
      connection_delay_(results.spec().coordination.connection_delay) {
  for (const AnswerPolicy& policy : controller.policies()) {
    if (!policy.trigger.empty() && !policy.is_on_request()) policies_.push_back(policy);
  }
  // Read again where they are needed again: a log may be longer than what can be kept.
  const auto values = [&results](const std::string& path, ResultsReader::Leading leading) -> CellValue {
    return [&results, &field = results.field(path), leading](std::int64_t cell) {
      return results.values(field, leading, one_cell(results.grid(), cell)).front();
    };
  };
  for (const AnswerPolicy& policy : policies_) {
    steps_.push_back(values(policy.delay, partition));
    const bool ends = !policy.aim.path.empty() && !policy.aim.lasts;
    aims_.push_back(ends ? values(policy.aim.path, std::nullopt) : CellValue());
  }
  left_.resize(policies_.size());
}

/// The most steps of the cells that the state may be in.
std::int32_t SilenceWatch::most_steps(std::size_t policy, const LogPosition& position) {
  std::int32_t most = kOutsideSafe;
  for (const std::int64_t cell : position.cells) most = std::max(most, steps_[policy](cell));
  return most;
}

SilenceWatch::Steps SilenceWatch::begun(std::size_t policy, const LogPosition& position) {
  if (has_aim(policy) && has_arrived_) return std::nullopt;
  const std::int32_t most = most_steps(policy, position);
  if (most < 0) return std::nullopt;
  return countdown_from(most, connection_delay_);
}

void SilenceWatch::look_for_aims(const LogPosition& position) {
  if (position.cells.empty()) return;
  for (const CellValue& aim : aims_) has_arrived_ = has_arrived_ || (aim && aim(position.cells.front()) == 0);
}

void SilenceWatch::begin(const LogPosition& position) {
  has_arrived_ = false;
  look_for_aims(position);
  for (std::size_t p = 0; p < left_.size(); ++p) left_[p] = begun(p, position);
}

std::optional<std::int32_t> SilenceWatch::countdown() const {
  return *std::max_element(left_.begin(), left_.end());
}

/// Whether the actions may be what a policy leaves the classes in one of the cells.
bool SilenceWatch::keeps(std::size_t policy, const LogPosition& position,
                         const std::vector<std::optional<std::int64_t>>& actions) {
  return std::any_of(position.cells.begin(), position.cells.end(), [&](std::int64_t cell) {
    const ActionSets sets = controller_.actions(policies_[policy], partition_, cell, *left_[policy]);
    for (std::size_t c = 0; c < actions.size(); ++c) {
      if (actions[c] && (*actions[c] < 0 || !sets[c][at(*actions[c])])) return false;
    }
    return true;
  });
}

bool SilenceWatch::leave(const LogPosition& position, Contact contact,
                         const std::vector<std::optional<std::int64_t>>& actions) {
  if (contact == Contact::yes) return false;
  for (std::size_t p = 0; p < left_.size(); ++p) {
    const bool is_before_aim = has_aim(p) && !has_arrived_;
    if (left_[p] && is_before_aim && !keeps(p, position, actions)) left_[p].reset();
  }
  return contact == Contact::no && countdown() == 0;
}

bool SilenceWatch::arrive(const LogPosition& position, Contact contact) {
  // All is safe there, and needs no contact.
  const bool has_left_safely = position.cells.empty() && !position.is_outside();
  if (!countdown() || has_left_safely) {
    begin(position);
    return false;
  }
  look_for_aims(position);
  bool is_broken = false;
  for (std::size_t p = 0; p < left_.size(); ++p) {
    const Steps fresh = begun(p, position);
    if (contact == Contact::yes || (contact == Contact::possible && !left_[p])) left_[p] = fresh;
    if (contact == Contact::yes || !left_[p]) continue;
    // Beyond the aim the countdown goes on, but what it is worth the delay says.
    const std::int32_t there = most_steps(has_aim(p) && has_arrived_ ? 0 : p, position);
    const std::int32_t after = one_less(*left_[p]);
    if (contact == Contact::possible) {
      left_[p] = there >= after ? std::max(Steps(after), fresh) : fresh;
    } else if (there >= after) {
      left_[p] = after;
    } else {
      is_broken = is_broken || *left_[p] > 0;
      left_[p] = there < 0 ? Steps() : there;
    }
  }
  return is_broken;
}

}  // namespace coordreq
