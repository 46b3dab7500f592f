#include "app/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/render.hpp"

namespace coordreq {
namespace {

bool is_joint(const Json& class_name) {
  return class_name.get<std::string>().find('+') != std::string::npos;
}

/// The sentence of one policy.
class Headline {
 public:
  /// @param entry the layers of the policy in the partition
  /// @param how AnswerPolicy::headline @param is_only there is no other policy
  Headline(const Json& partition, const Json& entry, const Json& document, const std::string& how,
           bool is_only)
      : entry_(entry), document_(document) {
    const Json& classes = partition["classes"];
    is_alone_ = std::none_of(classes.begin(), classes.end(), is_joint);
    is_plain_ = how.empty() && is_only;
    const std::string between = is_alone_ ? "" : " between classes";
    if (is_plain_) {
      suffix_ = "without coordination" + between;
    } else {
      suffix_ = "of silence " + (how.empty() ? "by independent choice" + between : how);
    }
    has_no_silence_ = how.empty() && !is_alone_ && classes.size() == 1;
  }

  [[nodiscard]] std::string text() const {
    const Json& layers = entry_["layers"];
    const auto last = static_cast<std::int64_t>(layers.size()) - 1;
    const std::int64_t kept = number_of(layers.back());
    if (entry_["truncated"]) {
      return fmt::format("Stopped at max_delay: {} {} {} {}, perhaps more.", cells(kept),
                         kept == 1 ? "allows" : "allow", steps(last), suffix_);
    }
    // The layers shrink strictly up to F, so the largest finite delay is F - 1.
    if (kept == 0) {
      return last <= 1 ? fmt::format("From no state is even one step {} safe.", suffix_)
                       : fmt::format("From the best state{}, {} safe.", best_state(), finite(last - 1));
    }
    if (has_no_silence_) return "All agents coordinate within every step, so every delay is unbounded.";
    if (last == 0) return all_text(kept);
    return fmt::format(
        "{}; {} safe.", unbounded_text(kept),
        last == 1 ? fmt::format("from the others not even one step {} is", suffix_)
                  : fmt::format("from the best of the others{}, {}", best_state(), finite(last - 1)));
  }

 private:
  [[nodiscard]] std::string who() const { return is_alone_ ? "agents" : "classes"; }
  [[nodiscard]] std::string steps(std::int64_t count) const { return duration(count, document_); }

  /// "3 steps (0.3 s) without coordination are"
  [[nodiscard]] std::string finite(std::int64_t count) const {
    return fmt::format("{} {} {}", steps(count), suffix_, count == 1 ? "is" : "are");
  }
  [[nodiscard]] std::string all_text(std::int64_t kept) const {
    if (is_plain_) return fmt::format("The {} never need to coordinate: every delay is unbounded.", who());
    return unbounded_text(kept) + ".";
  }
  /// Where no finite number of steps is the longest, the best state is one of these.
  [[nodiscard]] std::string unbounded_text(std::int64_t kept) const {
    const std::string from = cells(kept) + (entry_["layers"].size() < 3 ? best_state("e.g. ") : "");
    if (is_plain_) return fmt::format("From {} the {} never need to coordinate", from, who());
    return fmt::format("From {} any number of steps {} is safe", from, suffix_);
  }
  [[nodiscard]] std::string best_state(const char* before = "") const {
    const auto found = entry_.find("best_state");
    if (found == entry_.end() || found->is_null()) return "";
    return fmt::format(" ({}{})", before, values_text(*found));
  }

  const Json& entry_;
  const Json& document_;
  bool is_alone_ = true;
  bool is_plain_ = true;         ///< independent choice is all that the spec asks about
  bool has_no_silence_ = false;  ///< all agents coordinate within every step
  std::string suffix_;
};

}  // namespace

std::vector<std::string> headlines(const Json& partition, const Json& document,
                                   const std::vector<AnswerPolicy>& policies) {
  std::vector<std::string> sentences;
  for (const AnswerPolicy& policy : policies) {
    const Json& entry = policy.name.empty() ? partition : partition[policy.name];
    sentences.push_back(Headline(partition, entry, document, policy.headline, policies.size() == 1).text());
  }
  return sentences;
}

std::string headline_lines(const Json& partition, const Json& document,
                           const std::vector<AnswerPolicy>& policies) {
  std::string text;
  for (const std::string& sentence : headlines(partition, document, policies)) text += "  " + sentence + "\n";
  return text;
}

}  // namespace coordreq
