#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "base/thread_team.hpp"

namespace coordreq {

/// Work is counted, not timed, so that neither other programs nor threads have a say in what is confirmed. A
/// unit is about what one operation takes in ball arithmetic.
using Work = std::int64_t;
/// Units that a slow core does in a second, or more.
inline constexpr double kWorkOfSecond = 5e7;
[[nodiscard]] inline Work work_of_seconds(double seconds) {
  constexpr double kMost = 1e18;
  return static_cast<Work>(std::min(seconds * kWorkOfSecond, kMost));
}

/// Work that is left for questions, of which each may take an equal share, but at most a twentieth of the
/// whole. A part is kept back for answers that are begun when their share is spent. Not thread-safe: shares
/// are taken between loops.
class Budget {
 public:
  explicit Budget(Work all) : all_(all), left_(all) {}

  [[nodiscard]] bool is_spent() const { return to_share() <= 0; }
  [[nodiscard]] Work left() const { return std::max<Work>(left_, 0); }
  /// Work that one of `questions` questions may take; 0 once the budget is spent.
  [[nodiscard]] Work share(std::int64_t questions) const {
    return is_spent() ? 0
                      : std::clamp<Work>(to_share() / std::max<std::int64_t>(questions, 1), 1, most_of_one());
  }
  /// Work that an answer may take beyond its share, so that a block of so many questions takes no more than
  /// is kept back.
  [[nodiscard]] Work of_begun(std::int64_t block) const { return kept_back() / block; }
  void spend(Work used) { left_ -= used; }
  [[nodiscard]] Work all() const { return all_; }
  [[nodiscard]] Work spent() const { return all_ - left_; }
  /// How many posts are left open because it was spent.
  [[nodiscard]] std::int64_t left_open() const { return left_open_; }
  void leave_open(std::int64_t posts) { left_open_ += posts; }
  /// Takes from this budget what has come of a part of it.
  void settle(const Budget& fraction) {
    spend(fraction.spent());
    leave_open(fraction.left_open());
  }
  /// The part of this budget for `some` of `all` units of work.
  [[nodiscard]] Budget fraction(std::int64_t some, std::int64_t all) const {
    const double share = static_cast<double>(some) / static_cast<double>(std::max<std::int64_t>(all, 1));
    return Budget(static_cast<Work>(static_cast<double>(left()) * std::min(share, 1.0)));
  }

 private:
  [[nodiscard]] Work most_of_one() const { return std::max<Work>(all_ / 20, 1); }
  [[nodiscard]] Work kept_back() const { return all_ / 16; }
  [[nodiscard]] Work to_share() const { return left_ - kept_back(); }

  Work all_;
  Work left_;
  std::int64_t left_open_ = 0;
};

/// Answers one question: may take `most`, if that is 0 nothing. @returns what it took
using AnswerWithin = std::function<Work(std::int64_t question, Work most, int worker)>;

/// Answers questions 0, ..., count - 1 block by block, so that a budget is spent at the same question
/// whatever the number of threads. @param block questions that share what is left before any of them is
/// answered
/// @param answered receives how many are, after each block
void answer_within(Budget& budget, std::int64_t count, std::int64_t block, ThreadTeam& team,
                   const AnswerWithin& answer, const std::function<void(std::int64_t)>& answered = {});

}  // namespace coordreq
