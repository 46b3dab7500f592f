#include "verify/cell_checker.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "verify/cell_place.hpp"

namespace coordreq {
namespace {

constexpr std::int32_t kMustBeConnected = -3;

std::string steps(std::int32_t value) {
  return value == kForever ? "infinite" : std::to_string(value);
}

std::int32_t one_more(std::int32_t value) {
  return value == kForever ? kForever : value + 1;
}

std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay) {
  if (delay < 0 || delay == kForever) return delay;
  return delay < connection_delay ? kMustBeConnected : static_cast<std::int32_t>(delay - connection_delay);
}

}  // namespace

CellTallies::CellTallies(const CellCheck& check)
    : convention(*check.claims), has_controller(check.claims->has_controller) {
  for (const PartitionClaims& partition : check.claims->partitions) {
    delay.emplace_back("delay " + partition.name);
    trigger.emplace_back("trigger " + partition.name);
    actions.emplace_back("actions " + partition.name);
    has_actions.push_back(!partition.actions.empty());
  }
}

std::vector<Finding> CellTallies::findings() const {
  std::vector<Finding> result = {safe.finding(), invariant.finding(), collision_time.finding()};
  if (has_controller) result.push_back(controller.finding());
  convention.add_findings(result);
  for (std::size_t p = 0; p < delay.size(); ++p) {
    if (has_actions[p]) result.push_back(actions[p].finding());
    result.push_back(delay[p].finding());
    result.push_back(trigger[p].finding());
  }
  return result;
}

CellChecker::CellChecker(const CellCheck& check, CellTallies& tallies, SafeMemory& memory)
    : check_(check),
      spec_(*check.spec),
      claims_(*check.claims),
      tallies_(tallies),
      posts_(*check.posts),
      allowed_(*check.spec, *check.grid, *check.inputs, check.claims->listed),
      judge_(*check.spec, *check.grid, memory),
      inputs_(check.inputs->count()),
      admitted_(static_cast<std::size_t>(inputs_)) {
  if (check.tubes != nullptr) tubes_.emplace(*check.tubes);
  if (spec_.coordination.convention) convention_.emplace(spec_, *check.inputs, claims_, tallies.convention);
  for (const PartitionSpec& partition : spec_.coordination.partitions) {
    Partition& own = partitions_.emplace_back();
    for (const auto& agents : partition.classes) {
      own.classes.push_back(class_of(spec_, *check.inputs, agents));
      own.classes.back().tabulate();
      own.projection.emplace_back(static_cast<std::size_t>(own.classes.back().actions()));
    }
  }
}

void CellChecker::check(std::int64_t cell) {
  cell_ = cell;
  check_safe();
  std::fill(admitted_.begin(), admitted_.end(), 0);
  if (claims_.safe[at()] == 0) {
    check_outside();
  } else {
    posts_.go_to(cell);
    if (tubes_) tubes_->go_to(cell);
    allowed_.go_to(cell);
    if (claims_.invariant[at()] == 0) {
      check_escape();
    } else {
      check_stay();
    }
  }
  if (claims_.has_controller) check_controller();
  if (convention_) convention_->check(cell, admitted_, sound_only(), [this] { return place(); });
  for (std::size_t p = 0; p < partitions_.size(); ++p) check_partition(p);
}

void CellChecker::check_safe() {
  tallies_.safe.add_checked(1);
  const bool claimed = claims_.safe[at()] != 0;
  const SafeVerdict verdict = judge_.judge(cell_, claimed);
  if (!claimed && verdict == SafeVerdict::safe) {
    tallies_.safe.add_wrong(cell_, [&] { return place() + ": not in S, but it is safe"; });
  } else if (claimed && verdict == SafeVerdict::unsafe) {
    tallies_.safe.add_wrong(cell_, [&] { return place() + ": in S, but it is not safe"; });
  } else if (claimed && verdict == SafeVerdict::open) {
    tallies_.safe.add_unproven();
  }
}

void CellChecker::check_outside() {
  tallies_.invariant.add_checked(1);
  if (claims_.invariant[at()] != 0)
    tallies_.invariant.add_wrong(cell_, [&] { return place() + ": in K, but not in S"; });
  check_collision_time(0);
}

void CellChecker::check_collision_time(std::int32_t expected) {
  tallies_.collision_time.add_checked(1);
  const std::int32_t claimed = claims_.collision_time[at()];
  if (claimed == expected) return;
  if (sound_only() && claimed < expected && claimed > 0) {
    tallies_.collision_time.add_unproven();
    return;
  }
  tallies_.collision_time.add_wrong(
      cell_, [&] { return fmt::format("{}: {}, expected {}", place(), steps(claimed), steps(expected)); });
}

std::int32_t CellChecker::least(std::int64_t u, const std::vector<std::int32_t>& values,
                                std::int32_t blocked) {
  const std::int32_t value = posts_.least(u, values, blocked, kForever, memory_);
  return value != blocked && tubes_ && !tubes_->is_safe(u) ? blocked : value;
}

void CellChecker::forget() {
  memory_.assign(posts_.memory_size(), PostMinima::kNotKnown);
}

/// A cell of S outside K: why no coordination helps.
void CellChecker::check_escape() {
  const bool maximal = spec_.controller.synthesis == Synthesis::maximal;
  bool any = false;
  std::int32_t best = maximal ? 0 : kForever;
  forget();
  for (std::int64_t u = 0; u < inputs_; ++u) {
    if (!allowed_(u)) continue;
    any = true;
    const std::int32_t time = least(u, claims_.collision_time, 0);
    best = maximal ? std::max(best, time) : std::min(best, time);
  }
  tallies_.invariant.add_checked(1);
  if (any && best == kForever) {
    if (sound_only()) {
      tallies_.invariant.add_unproven();
    } else {
      tallies_.invariant.add_wrong(
          cell_, [&] { return place() + ": not in K, but agents that coordinate stay in K for ever"; });
    }
  }
  check_collision_time(any ? one_more(best) : 1);
}

/// A cell of K: that it can be kept there, and C(x).
void CellChecker::check_stay() {
  check_collision_time(kForever);
  find_admitted();
  tallies_.invariant.add_checked(1);
  if (std::find(admitted_.begin(), admitted_.end(), 1) == admitted_.end()) {
    tallies_.invariant.add_wrong(cell_,
                                 [&] { return place() + ": in K, but no allowed input keeps it there"; });
  }
}

/// Asks the delays of the first partition, which are negative outside K and nowhere else: so they are at hand
/// for delay_by_definition().
void CellChecker::find_admitted() {
  const bool given = spec_.controller.synthesis == Synthesis::given;
  bool all_stay = true;
  forget();
  for (std::int64_t u = 0; u < inputs_; ++u) {
    if (!allowed_(u)) continue;
    const bool stays = least(u, claims_.partitions.front().delay, kOutsideInvariant) >= 0;
    all_stay = all_stay && stays;
    admitted_[static_cast<std::size_t>(u)] = given || stays ? 1 : 0;
  }
  if (given && !all_stay) {
    tallies_.invariant.add_wrong(cell_,
                                 [&] { return place() + ": in K, but an allowed input leads out of it"; });
  }
}

/// Bits that differ from `expected`; bits beyond the last action have to be 0.
/// @param fewer set if a bit of `expected` is missing
std::int64_t CellChecker::wrong_bits(const std::vector<std::uint8_t>& bytes,
                                     const std::vector<std::uint8_t>& expected, bool& fewer) const {
  const std::size_t length = (expected.size() + 7) / 8;
  std::int64_t wrong = 0;
  for (std::size_t a = 0; a < length * 8; ++a) {
    const bool stored = (bytes[at() * length + a / 8] >> (a % 8) & 1U) != 0;
    const bool right = a < expected.size() && expected[a] != 0;
    if (stored && !right) ++wrong;
    if (!stored && right) fewer = true;
  }
  return wrong;
}

void CellChecker::check_controller() {
  tallies_.controller.add_checked(1);
  bool fewer = false;
  const std::int64_t extra = wrong_bits(claims_.controller, admitted_, fewer);
  if (extra > 0) {
    tallies_.controller.add_wrong(
        cell_, [&] { return fmt::format("{}: {} joint inputs too many", place(), extra); });
  } else if (fewer && sound_only()) {
    tallies_.controller.add_unproven();
  } else if (fewer) {
    tallies_.controller.add_wrong(cell_, [&] { return place() + ": joint inputs are missing"; });
  }
}

void CellChecker::check_partition(std::size_t p) {
  const PartitionClaims& claims = claims_.partitions[p];
  const bool stays = claims_.safe[at()] != 0 && claims_.invariant[at()] != 0;
  project(partitions_[p]);
  if (tallies_.has_actions[p]) check_actions(p);
  std::int32_t expected = claims_.safe[at()] != 0 ? kOutsideInvariant : kOutsideSafe;
  if (stays) expected = delay_by_definition(p);
  check_delay(p, expected);
  tallies_.trigger[p].add_checked(1);
  const std::int32_t trigger = trigger_of(claims.delay[at()], spec_.coordination.connection_delay);
  if (claims.trigger[at()] != trigger) {
    tallies_.trigger[p].add_wrong(cell_, [&] {
      return fmt::format("{}: {}, expected {}", place(), steps(claims.trigger[at()]), steps(trigger));
    });
  }
}

void CellChecker::project(Partition& partition) const {
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    std::vector<std::uint8_t>& projection = partition.projection[c];
    const InputClass& own = partition.classes[c];
    std::fill(projection.begin(), projection.end(), 0);
    for (std::size_t u = 0; u < admitted_.size(); ++u) {
      if (admitted_[u] != 0)
        projection[static_cast<std::size_t>(own.action(static_cast<std::int64_t>(u)))] = 1;
    }
  }
}

/// Where posts are only enclosures, the actions of the file are the ones to go on with.
void CellChecker::check_actions(std::size_t p) {
  Partition& partition = partitions_[p];
  tallies_.actions[p].add_checked(1);
  bool fewer = false;
  std::int64_t extra = 0;
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    const std::vector<std::uint8_t>& bytes = claims_.partitions[p].actions[c];
    std::vector<std::uint8_t>& projection = partition.projection[c];
    extra += wrong_bits(bytes, projection, fewer);
    const std::size_t length = (projection.size() + 7) / 8;
    for (std::size_t a = 0; sound_only() && a < projection.size(); ++a) {
      if ((bytes[at() * length + a / 8] >> (a % 8) & 1U) == 0) projection[a] = 0;
    }
  }
  if (extra > 0) {
    tallies_.actions[p].add_wrong(cell_,
                                  [&] { return fmt::format("{}: {} actions too many", place(), extra); });
  } else if (fewer && sound_only()) {
    tallies_.actions[p].add_unproven();
  } else if (fewer) {
    tallies_.actions[p].add_wrong(cell_, [&] { return place() + ": actions are missing"; });
  }
}

bool CellChecker::is_choice(const Partition& partition, std::int64_t u) const {
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    const std::int64_t action = partition.classes[c].action(u);
    if (partition.projection[c][static_cast<std::size_t>(action)] == 0) return false;
  }
  return true;
}

std::int32_t CellChecker::delay_by_definition(std::size_t p) {
  const PartitionClaims& claims = claims_.partitions[p];
  bool any = false;
  std::int32_t worst = kForever;
  if (p > 0) forget();
  for (std::int64_t u = 0; u < inputs_ && worst > kOutsideInvariant; ++u) {
    if (!is_choice(partitions_[p], u)) continue;
    any = true;
    worst = std::min(worst, std::max(least(u, claims.delay, kOutsideInvariant), kOutsideInvariant));
  }
  const std::int32_t delay = any ? one_more(worst) : 0;
  const bool truncated = claims.fixed_point_index < 0 && spec_.coordination.max_delay.has_value();
  return truncated ? std::min(delay, static_cast<std::int32_t>(*spec_.coordination.max_delay)) : delay;
}

void CellChecker::check_delay(std::size_t p, std::int32_t expected) {
  tallies_.delay[p].add_checked(1);
  const std::int32_t claimed = claims_.partitions[p].delay[at()];
  if (claimed == expected) return;
  const bool other_choices = !tallies_.has_actions[p];  // perhaps: the file does not say which there are
  if (sound_only() && expected >= 0 && claimed >= 0 && (claimed < expected || other_choices)) {
    tallies_.delay[p].add_unproven();
    return;
  }
  tallies_.delay[p].add_wrong(
      cell_, [&] { return fmt::format("{}: {}, expected {}", place(), steps(claimed), steps(expected)); });
}

std::string CellChecker::place() const {
  return place_of(*check_.grid, cell_);
}

}  // namespace coordreq
