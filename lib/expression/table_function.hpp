#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "expression/program.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// The meaning of a table where an argument leaves its axis.
enum class BeyondAxis : std::uint8_t {
  clamp,   ///< the value at the nearest end
  refuse,  ///< undefined, like the root of a negative number
};

/// A function of one or two numbers. A call of it is its program with the arguments for variables 0 and 1.
struct TableFunction {
  std::size_t arguments = 1;
  Program value;
};

/// The tables that an expression can call.
struct TableLookup {
  /// Null if the name is no table. May throw SpecError.
  std::function<const TableFunction*(std::string_view name)> find;
  /// Of a name that is called like one but is none, for the end of the message.
  std::function<std::string(std::string_view name)> hint = [](std::string_view) { return std::string(); };
};

/// The continuous function that is linear between neighbouring points (x[i], value[i]), made of the operators
/// of the grammar. A sum of kinks would be shorter, but intervals would not see that its terms belong
/// together. So a part that rises or falls is a maximum of minima of its lines (Tarela and Martinez 1999),
/// and parts are joined by minimum at a peak and by maximum at a valley. Intervals then enclose the range
/// exactly if the function rises, falls or turns once, and at a kink the derivatives are the hull of the
/// slopes that meet there. Two opposite slopes are an `abs`.
/// @pre at least two x, ascending; as many values
[[nodiscard]] TableFunction linear_table(std::span<const Rational> x, std::span<const Rational> value,
                                         BeyondAxis beyond);

/// The continuous function that is bilinear between four neighbouring points: the sum over j of
/// linear_table(x, rows[j]) times the hat function of y[j]. Its middle value is taken out of the sum, so that
/// intervals widen with the variation of the table and not with its size.
/// @pre at least two x and y, ascending; a row for each y, with a value for each x
[[nodiscard]] TableFunction bilinear_table(std::span<const Rational> x, std::span<const Rational> y,
                                           const std::vector<std::vector<Rational>>& rows, BeyondAxis beyond);

/// link() and mentioned_names() where expressions may call tables. Their names are not among those mentioned.
[[nodiscard]] Program link(std::string_view text, const Lookup& lookup, const TableLookup& tables,
                           ExpectedType expected, std::string_view where);
[[nodiscard]] std::vector<std::string> mentioned_names(std::string_view text, const TableLookup& tables,
                                                       std::string_view where);

}  // namespace coordreq
