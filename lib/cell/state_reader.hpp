#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/csv.hpp"
#include "cell/state_text.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// Reads states from a stream, one a line, as CSV or as JSON lines: what the first line is decides.
///
/// CSV: the first line names the states, in any order; values are decimals or constant expressions, in quotes
/// ("...") where they hold commas. JSON lines: an object a line, whose values are numbers or strings with a
/// constant expression. Numbers are exact: the decimals that were typed. Empty lines are skipped. Columns and
/// keys that name no state (the time of a log, notes) are *extra*, and kept as texts.
/// Errors are UsageErrors that name the line; a stream that cannot be read is an IoError.
class StateReader {
 public:
  enum class Format : std::uint8_t { csv, json_lines };

  /// Reads up to the first line that is not empty. @pre unchecked: `stream` outlives this object.
  /// @param source for messages
  StateReader(std::istream& stream, StateNames states, std::string source);

  [[nodiscard]] Format format() const { return format_; }
  /// The next state, in the order of the names; nothing at the end.
  [[nodiscard]] std::optional<std::vector<Rational>> next();

  struct Extra {
    std::string name;
    std::string value;     ///< without the quotation marks of CSV
    bool is_json = false;  ///< of JSON lines: JSON text
    /// The text of the value, without blanks around it; empty if there is none, or null.
    [[nodiscard]] std::string text() const;
  };
  /// Names without values: of CSV once it is open, of JSON lines those of the last state.
  [[nodiscard]] const std::vector<std::string>& extra_names() const { return extra_names_; }
  /// Values beside the last state, in the order of extra_names().
  [[nodiscard]] const std::vector<Extra>& extra() const { return extra_; }
  /// Whether the last state was given a value, by the order of the names; else it is 0.
  [[nodiscard]] bool is_given(std::size_t state) const { return is_given_[state]; }
  /// The line of the last state, for messages: "standard input, line 3".
  [[nodiscard]] std::string location() const;

 private:
  [[nodiscard]] RefuseLine refusal() const;
  [[nodiscard]] bool read_line();
  void read_header();
  [[nodiscard]] std::vector<Rational> csv_state();
  [[nodiscard]] std::vector<Rational> json_state();
  [[nodiscard]] std::size_t state_of(std::string_view name) const;
  [[nodiscard]] std::string missing(const char* what, const std::string& state) const;

  std::istream& stream_;
  std::vector<std::string> names_;
  std::size_t needed_;
  std::string source_;
  Format format_ = Format::csv;
  std::vector<std::size_t> columns_;  ///< state of each CSV column; as many as there are states: extra
  std::vector<std::string> extra_names_;
  std::vector<Extra> extra_;
  std::vector<bool> is_given_;
  std::string line_;
  std::int64_t line_number_ = 0;
  bool pending_ = false;  ///< `line_` has not been used yet
};

}  // namespace coordreq
