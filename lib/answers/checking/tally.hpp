#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace coordreq {

/// The result of one kind of check.
struct Finding {
  std::string check;                  ///< "S", "K", "delay PARTITION", ...
  std::int64_t checked = 0;           ///< how many cells, entries or attributes were checked
  std::int64_t wrong = 0;             ///< how many of them are not as they should be
  std::int64_t unproven = 0;          ///< how many could be neither confirmed nor refuted
  std::vector<std::string> examples;  ///< the first few wrong ones: where, what was found, what was expected
  std::vector<std::string> doubts;    ///< the first few that are not confirmed: where, and why
  std::string note;  ///< the assumption of the check, or why something is unproven; may be empty
};

/// Counts what several threads find, and keeps the first few wrong ones by their number.
class Tally {
 public:
  static constexpr std::size_t kMostExamples = 3;

  explicit Tally(std::string check) : check_(std::move(check)) {}

  void add_checked(std::int64_t count) { checked_ += count; }
  void add_unproven() { ++unproven_; }
  /// @param describe called only where its text is kept
  template <class Describe>
  void add_unproven(std::int64_t number, const Describe& describe) {
    ++unproven_;
    keep(doubts_, number, describe);
  }
  template <class Describe>
  void add_wrong(std::int64_t number, const Describe& describe) {
    ++wrong_;
    keep(examples_, number, describe);
  }
  void set_note(std::string note) { note_ = std::move(note); }

  [[nodiscard]] Finding finding() const {
    Finding result{
        .check = check_, .checked = checked_, .wrong = wrong_, .unproven = unproven_, .note = note_};
    for (const auto& example : examples_) result.examples.push_back(example.second);
    for (const auto& doubt : doubts_) result.doubts.push_back(doubt.second);
    return result;
  }

 private:
  template <class Describe>
  void keep(std::map<std::int64_t, std::string>& texts, std::int64_t number, const Describe& describe) {
    const std::lock_guard lock(mutex_);
    if (texts.size() == kMostExamples && texts.rbegin()->first <= number) return;
    texts.try_emplace(number, describe());
    if (texts.size() > kMostExamples) texts.erase(std::prev(texts.end()));
  }

  std::string check_;
  std::string note_;
  std::atomic<std::int64_t> checked_{0};
  std::atomic<std::int64_t> wrong_{0};
  std::atomic<std::int64_t> unproven_{0};
  std::mutex mutex_;
  std::map<std::int64_t, std::string> examples_;
  std::map<std::int64_t, std::string> doubts_;
};

}  // namespace coordreq
