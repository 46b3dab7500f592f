#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace coordreq {

/// Several things that are wrong with one spec. what() is the first one.
class SpecErrors : public SpecError {
 public:
  /// @pre there are at least two
  explicit SpecErrors(std::vector<std::string> lines);

  /// [error] the text that it would have alone.
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

/// Collects what is wrong in parts that do not depend on each other.
class ErrorList {
 public:
  /// An author mends a few errors at a time; the later ones of a long list often follow from the first.
  static constexpr std::size_t kMost = 10;

  /// Works on a part, and keeps what is wrong with it; where enough is wrong it does nothing. @returns
  /// whether the part is right
  template <class Work>
  bool attempt(const Work& work) {
    if (is_full()) return false;
    try {
      work();
      return true;
    } catch (const SpecErrors& errors) {
      for (const std::string& line : errors.lines()) add(line);
    } catch (const SpecError& error) {
      add(error.what());
    }
    return false;
  }

  void add(std::string line) {
    if (!is_full()) lines_.push_back(std::move(line));
  }
  [[nodiscard]] bool is_full() const { return lines_.size() >= kMost; }

  /// @throws SpecErrors, or SpecError if there is one only
  void raise() const;

 private:
  std::vector<std::string> lines_;
};

}  // namespace coordreq
