#include "app/option_values.hpp"

#include <fmt/format.h>

#include <optional>

#include "app/text.hpp"
#include "cell/state_text.hpp"
#include "numeric/rational.hpp"
#include "spec/system_spec.hpp"
#include "spec/units.hpp"

namespace coordreq {
namespace {

/// The time in the unit of the spec; nothing if it is none.
std::optional<Rational> time_of(const std::string& text, const std::string& unit) {
  if (const std::optional<Rational> time = time_in(text, unit)) return time;
  if (unit.empty() || !text.ends_with(unit) || text.size() == unit.size()) return std::nullopt;
  return parse_decimal(trimmed(std::string_view(text).substr(0, text.size() - unit.size())));
}

}  // namespace

std::int64_t steps_or_time(const std::string& text, const DynamicsSpec& dynamics, const std::string& option,
                           const StepBounds& bounds) {
  constexpr std::int64_t kMost = INT32_MAX - 1;
  const std::string steps_expected =
      bounds.least == 0 ? "a number of steps" : fmt::format("a number of steps from {} on", bounds.least);
  const std::string expected =
      dynamics.unit.empty() ? steps_expected
                            : fmt::format("{}, or a time, e.g. 2{}{}", steps_expected,
                                          is_time_unit(dynamics.unit) ? "" : " ", printable(dynamics.unit));
  const std::string amount(trimmed(text));
  const std::optional<Rational> time = time_of(amount, dynamics.unit);
  const std::optional<Rational> number =
      time ? std::optional(Rational(*time / dynamics.period)) : parse_decimal(amount);
  if (!number || *number < 0 || (!time && !is_integer(*number)) ||
      *number > Rational(static_cast<long>(kMost)))
    fail_value(expected, text, option);
  const std::int64_t steps = bounds.is_upper_limit ? floor_to_int(*number) : ceil_to_int(*number);
  if (steps < bounds.least) fail_value(expected, text, option);
  return steps;
}

}  // namespace coordreq
