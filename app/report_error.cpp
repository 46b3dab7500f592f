#include "app/report_error.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <string_view>

#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

constexpr const char* kNoMemory =
    "the system gave no more memory; make the grids coarser, or find the need with \"coordreq validate\"";

void print(std::string_view what) {
  write_diagnostics("coordreq: error: " + std::string(what) + "\n");
}

/// One line of a length that can be read, whatever a user has typed: no word fills more than a few lines, and
/// no line a screen.
std::string error_text(std::string_view what) {
  constexpr std::size_t kLongestWord = 200, kKeptAtItsEnd = 20, kLongestLine = 2000;
  std::string text;
  const std::string line = printable(what);
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t end = std::min(line.find(' ', begin), line.size() - 1) + 1;
    const std::string_view word = std::string_view(line).substr(begin, end - begin);
    text += shortened(word, kLongestWord, kKeptAtItsEnd);
    begin = end;
  }
  return shortened(text, kLongestLine, kKeptAtItsEnd);
}

int report() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    // No string is built here: there may be no memory for one.
    write_diagnostics("coordreq: error: ");
    write_diagnostics(kNoMemory);
    write_diagnostics("\n");
    return static_cast<int>(ExitCode::limit);
  } catch (...) {
    const Failure failure = describe_current_exception();
    print(failure.what);
    return failure.exit_code;
  }
}

}  // namespace

Failure describe_current_exception() {
  try {
    throw;
  } catch (const Error& error) {
    return {error_text(error.what()), static_cast<int>(error.exit_code())};
  } catch (const std::bad_alloc&) {
    return {kNoMemory, static_cast<int>(ExitCode::limit)};
  } catch (const std::exception& error) {
    return {std::string("internal error, please report it: ") + error_text(error.what()), kInternalError};
  } catch (...) {
    return {"internal error, please report it: an exception of unknown type", kInternalError};
  }
}

void report_failure(const std::string& subject, const Failure& failure) {
  print(printable(subject) + ": " + failure.what);
}

int report_current_exception() noexcept {
  try {
    return report();
  } catch (...) {
    write_diagnostics("coordreq: error: the system gave no more memory\n");
    return static_cast<int>(ExitCode::limit);
  }
}

}  // namespace coordreq
