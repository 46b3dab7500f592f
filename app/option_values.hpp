#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/simulate.hpp"
#include "spec/spec_types.hpp"

// Readers of the values of options. Every reader throws UsageError with what was found, what was
// expected, and the option as the location.
namespace coordreq {

[[noreturn]] void fail_value(const std::string& expected, const std::string& found,
                             const std::string& option);

/// "a whole number from 1 to 1024".
[[nodiscard]] std::string range_text(const std::string& lowest, const std::string& highest);

/// A whole number from `lowest` to `highest`.
template <class Number>
struct WholeNumber {
  Number lowest;
  Number highest;

  Number operator()(const std::string& text, const std::string& option) const {
    Number value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value >= lowest && value <= highest)
      return value;
    fail_value(range_text(std::to_string(lowest), std::to_string(highest)), text, option);
  }
};

/// One of a few names.
template <class Meaning>
struct OneOf {
  std::vector<std::pair<const char*, Meaning>> choices;
  const char* others = "";  ///< what else there may be, for the message

  Meaning operator()(const std::string& text, const std::string& option) const {
    for (const auto& [choice, meaning] : choices) {
      if (text == choice) return meaning;
    }
    fail_value(expected(), text, option);
  }
  /// "a, b or c"
  [[nodiscard]] std::string expected() const {
    std::string text;
    const std::string_view last = others;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      const bool is_last = last.empty() && i + 1 == choices.size();
      text += std::string(i == 0 ? "" : is_last ? " or " : ", ") + choices[i].first;
    }
    return last.empty() ? text : text + " or " + others;
  }
};

[[nodiscard]] std::string as_typed(const std::string& text, const std::string& option);

/// Not "-", and not nothing.
[[nodiscard]] std::string file_name(const std::string& text, const std::string& option);

/// At least 0 and at most 10^9.
[[nodiscard]] double seconds(const std::string& text, const std::string& option);

/// The bytes that "500M", "2G", "1.5GiB" or "1048576" stand for; K, M, G, T are powers of 1024, with or
/// without "B" or "iB", in either case. Rounded down; at least one.
[[nodiscard]] std::uint64_t memory_size(const std::string& text, const std::string& option);

/// "w1=0.1,w2=1/3": values by name, in the order given; each once.
[[nodiscard]] NamedValues named_values(const std::string& text, const std::string& option);

/// Bounds of a number of steps, and how a time becomes steps.
struct StepBounds {
  std::int64_t least = 1;
  bool is_upper_limit = false;  ///< then a time is rounded down to periods, else up
};

/// "4" steps, or "2 s", "500ms", "1h": a time, in periods of the spec; "2.5 round" in a unit of the spec that
/// is no unit of time.
/// @throws UsageError naming the option
[[nodiscard]] std::int64_t steps_or_time(const std::string& text, const DynamicsSpec& dynamics,
                                         const std::string& option, const StepBounds& bounds = {});

/// The memory that this process may use, in bytes: what the machine has, or the lowest limit of the control
/// groups (containers) it runs in if that is lower. Nothing if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

}  // namespace coordreq
