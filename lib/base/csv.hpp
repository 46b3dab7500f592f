#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace coordreq {

/// `text` without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Throws the error of whoever reads the table, with the location.
using RefuseLine = std::function<void(const std::string& what)>;

/// The names of the columns in the first line of a table as CSV (RFC 4180), without blanks around them.
/// @param refuse is called for quotation marks that are not closed, and for tables with other signs between
///   columns, as they are usual where numbers are written with commas
[[nodiscard]] std::vector<std::string> csv_columns(std::string_view line, const RefuseLine& refuse);

/// The texts in a line below it, as many as there are columns. @param refuse likewise, and for any other
/// number
[[nodiscard]] std::vector<std::string> csv_values(std::string_view line, std::size_t columns,
                                                  const RefuseLine& refuse);

}  // namespace coordreq
