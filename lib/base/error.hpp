#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace coordreq {

/// Exit codes of the program; fixed by the contract with users.
enum class ExitCode : int {
  success = 0,
  requirement_failed = 1,
  usage = 2,
  invalid_input = 3,
  limit = 4,
  input_output = 5,
  interrupted = 130,
};

/// An error that a user can act on. `what()` is the one line to print after "coordreq: error: ":
/// WHAT (WHERE), where WHERE names the JSON pointer, the line and column, or the file.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, std::string_view what, std::string_view where)
      : std::runtime_error(where.empty() ? std::string(what)
                                         : std::string(what) + " (" + std::string(where) + ")"),
        code_(code) {}

  [[nodiscard]] ExitCode exit_code() const { return code_; }

 private:
  ExitCode code_;
};

/// A problem spec that breaks the contract; `where` is a JSON pointer, perhaps with a position in an
/// expression.
class SpecError : public Error {
 public:
  explicit SpecError(std::string_view what, std::string_view where = {})
      : Error(ExitCode::invalid_input, what, where) {}
};

/// A results file that is not one of ours or is damaged; `where` is its path or a dataset in it.
class ResultsError : public Error {
 public:
  explicit ResultsError(std::string_view what, std::string_view where = {})
      : Error(ExitCode::invalid_input, what, where) {}
};

/// A file with a controller that does not fit or is damaged; `where` is its path with the location in it.
class ControllerError : public Error {
 public:
  explicit ControllerError(std::string_view what, std::string_view where = {})
      : Error(ExitCode::invalid_input, what, where) {}
};

/// More memory or more cells than allowed, refused before the work starts.
class LimitError : public Error {
 public:
  explicit LimitError(std::string_view what, std::string_view where = {})
      : Error(ExitCode::limit, what, where) {}
};

/// A file that cannot be read or written; `where` is its path.
class IoError : public Error {
 public:
  explicit IoError(std::string_view what, std::string_view where = {})
      : Error(ExitCode::input_output, what, where) {}
};

/// A command line that cannot be understood.
class UsageError : public Error {
 public:
  explicit UsageError(std::string_view what, std::string_view where = {})
      : Error(ExitCode::usage, what, where) {}
};

}  // namespace coordreq
