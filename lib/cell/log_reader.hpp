#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "cell/state_reader.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A sample of a log, and the step that follows it.
struct LogRow {
  std::string location;                         ///< for messages: "standard input, line 3"
  std::vector<Rational> state;                  ///< as measured; 0 where it is not given
  std::vector<bool> is_given;                   ///< [state]: all but those that memories keep
  std::vector<std::optional<Rational>> inputs;  ///< [input] from the sample on; nothing: not logged
  std::optional<bool> connected;                ///< whether all agents agreed on them; nothing: not logged
  std::optional<Rational> time;                 ///< in the unit of the period
};

/// Reads a log, one sample a line, as StateReader reads states. Of the columns that name no state it takes
/// those of inputs, `t` and `connected` (0 or 1), all of which may be missing or empty; a state or an input
/// may have such a name itself.
/// Errors are UsageErrors that name the line, as there.
class LogReader {
 public:
  /// @pre unchecked: `stream` and `spec` outlive this object. @param source for messages
  LogReader(std::istream& stream, const SystemSpec& spec, std::string source);

  [[nodiscard]] std::optional<LogRow> next();
  /// Names that mean nothing here: of CSV at once, of JSON lines those of the last sample.
  [[nodiscard]] std::vector<std::string> unknown_names() const;

 private:
  void check_names() const;
  void take(const StateReader::Extra& extra, LogRow& row) const;
  [[nodiscard]] std::optional<std::size_t> input_of(const std::string& name) const;

  std::vector<std::string> inputs_;
  StateReader states_;
};

}  // namespace coordreq
