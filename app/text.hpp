#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/grouped.hpp"

// Elements of text for people.
namespace coordreq {

/// `text` on one line: control characters and what is not UTF-8 are spelt out (\n, \x1b), all else stays.
[[nodiscard]] std::string printable(std::string_view text);

/// The text, of which so many bytes at most stay: "begin...end", so many of them at the end. Characters stay
/// whole. @pre most > at_end + 3
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most, std::size_t at_end);

/// The text in quotes as error lines repeat it: printable, of at most 200 bytes.
[[nodiscard]] std::string echoed(std::string_view text);

/// "v1 [m/s]", or "n" without a unit.
[[nodiscard]] std::string column_heading(const std::string& name, const std::string& unit);
/// 1 -> "1 cell", 1234 -> "1,234 cells". @pre count >= 0
[[nodiscard]] std::string cells(std::int64_t count);

/// 1536 -> "1.5 KiB".
[[nodiscard]] std::string byte_size(std::uint64_t bytes);

/// "28 steps (0.28 s)", "1 step"; without the time if `unit` is empty. `unit` is user text.
[[nodiscard]] std::string duration(std::int64_t steps, double period, std::string_view unit);

/// "6 m", "0.125 rad", "1,234 m", "0.5" without a unit: three digits, all of those before the point.
/// @pre value >= 0
[[nodiscard]] std::string rough_amount(double value, std::string_view unit);

/// "12 s", "3 min 20 s", "5 h 12 min", "3 days 4 h"; less than 10 s with a tenth. @pre seconds >= 0
[[nodiscard]] std::string time_span(double seconds);

/// The guarantee of a result as text: "samples" -> "samples: at the sampling instants, for every point of a
/// cell".
[[nodiscard]] std::string guarantee_text(std::string_view guarantee);

/// The numbers with blanks between, the middle of a long list left out: "9 8 7 6 5 4 ... 2 1 0".
[[nodiscard]] std::string shortened(const std::vector<std::int64_t>& numbers);

/// Rows of cells in aligned columns, two blanks between; the first row is the heading. The last cell of a row
/// with fewer cells than columns runs on, without making its column wider.
class Table {
 public:
  enum class Align : std::uint8_t { left, right };

  /// @param columns their alignment; every row has at most that many cells
  explicit Table(std::vector<Align> columns) : columns_(std::move(columns)), widths_(columns_.size(), 0) {}

  void add(std::vector<std::string> row);
  /// Every line ends in a newline and has no blanks at its end.
  [[nodiscard]] std::string text() const;

  /// For a table that is printed as it grows: makes columns as wide as the cells of this row, which is not
  /// one of the table.
  void widen(const std::vector<std::string>& row);
  /// A row that is not added, as a line of this table.
  [[nodiscard]] std::string line(const std::vector<std::string>& row) const;

 private:
  /// Number of cells of the row that are aligned.
  [[nodiscard]] std::size_t aligned(const std::vector<std::string>& row) const;

  std::vector<Align> columns_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace coordreq
