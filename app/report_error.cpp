#include "app/report_error.hpp"

#include <fmt/format.h>
#include <gmp.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "base/error.hpp"
#include "base/json.hpp"
#include "base/process_memory.hpp"
#include "base/requires.hpp"
#include "spec/spec_errors.hpp"

namespace coordreq {
namespace {

const char* no_memory() {
  return is_held_to_memory()
             ? "more memory is needed than the limit allows, and than was estimated (--max-memory)"
             : "the system gave no more memory; make the grids coarser, or find the need with \"coordreq "
               "validate\"";
}

/// GMP would end the program where there is no memory, with its own message.
void* allocate(std::size_t bytes) {
  void* const block = std::malloc(bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void* reallocate(void* old, std::size_t /*old_bytes*/, std::size_t bytes) {
  void* const block = std::realloc(old, bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void print(std::string_view what) {
  write_diagnostics("coordreq: error: " + std::string(what) + "\n");
}

constexpr std::size_t kMostEchoed = 200, kKeptAtItsEnd = 20, kLongestLine = 1000;

/// The spans between quotation marks: cut at the most where they repeat what a user has typed, which is what
/// stands in quotes.
std::string with_quotes_cut(std::string_view text) {
  std::string result;
  bool is_quoted = false;
  while (true) {
    const std::size_t end = text.find('\'');
    const std::string_view span = text.substr(0, end);
    result += is_quoted ? shortened(span, kMostEchoed, kKeptAtItsEnd) : std::string(span);
    if (end == std::string_view::npos) return result;
    result += '\'';
    is_quoted = !is_quoted;
    text.remove_prefix(end + 1);
  }
}

/// WHAT (WHERE) as one line of a length that can be read, whatever a user has typed: no quoted text, no
/// location and no unbroken text beyond 200 bytes, no line beyond 1,000.
std::string error_text(std::string_view what) {
  std::string line = printable(what);
  if (const std::size_t location = line.rfind(" ("); location != std::string::npos && line.back() == ')') {
    const std::string where = line.substr(location + 2, line.size() - location - 3);
    line = line.substr(0, location + 2) + shortened(where, kMostEchoed, kKeptAtItsEnd) + ")";
  }
  line = with_quotes_cut(line);
  std::string text;
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t end = std::min(line.find(' ', begin), line.size() - 1) + 1;
    text += shortened(std::string_view(line).substr(begin, end - begin), kMostEchoed + 4, kKeptAtItsEnd);
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
    write_diagnostics(no_memory());
    write_diagnostics("\n");
    return static_cast<int>(ExitCode::limit);
  } catch (...) {
    const Failure failure = describe_current_exception();
    print(failure.what);
    for (const std::string& line : failure.more) print(line);
    return failure.exit_code;
  }
}

/// The current exception as a document. An interrupt is none: mostly it ends the program where no text can
/// be made.
void report_as_json() noexcept {
  if (has_output()) return;
  try {
    const Failure failure = describe_current_exception();
    if (failure.exit_code == static_cast<int>(ExitCode::interrupted)) return;
    Json json = {{"error", failure.what}};
    if (!failure.more.empty()) json["more_errors"] = failure.more;
    json["exit_code"] = failure.exit_code;
    write_output(json_text(json));
  } catch (...) {
    // Standard error has the message; there is no memory for another, or nothing reads it.
  }
}

}  // namespace

std::string report_request() {
  constexpr std::string_view kAddress = COORDREQ_ISSUES;
  return kAddress.empty() ? "please report it with `coordreq --version`"
                          : fmt::format("please report it with `coordreq --version` to {}", kAddress);
}

Failure describe_current_exception() {
  REQUIRES(std::current_exception() != nullptr);
  try {
    throw;
  } catch (const SpecErrors& errors) {
    Failure failure{error_text(errors.what()), static_cast<int>(errors.exit_code()), {}};
    for (std::size_t i = 1; i < errors.lines().size(); ++i)
      failure.more.push_back(error_text(errors.lines()[i]));
    return failure;
  } catch (const Error& error) {
    return {error_text(error.what()), static_cast<int>(error.exit_code()), {}};
  } catch (const std::bad_alloc&) {
    return {no_memory(), static_cast<int>(ExitCode::limit), {}};
  } catch (const std::exception& error) {
    return {fmt::format("internal error, {}: {}", report_request(), error_text(error.what())),
            kInternalError,
            {}};
  } catch (...) {
    return {fmt::format("internal error, {}: an exception of unknown type", report_request()),
            kInternalError,
            {}};
  }
}

void report_failure(const std::string& subject, const Failure& failure) {
  const std::string start = shortened(printable(subject), kMostEchoed, kKeptAtItsEnd) + ": ";
  print(start + failure.what);
  for (const std::string& line : failure.more) print(start + line);
}

void report_what_terminates() {
  std::set_terminate([] {
    if (std::current_exception()) std::_Exit(report_current_exception());
    std::abort();
  });
  mp_set_memory_functions(allocate, reallocate, nullptr);
}

bool asks_for_json(int argc, const char* const* argv) noexcept {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    if (std::string_view(argv[i]) == "--json") return true;
  }
  return false;
}

int report_current_exception(bool as_json) noexcept {
  REQUIRES(std::current_exception() != nullptr);
  try {
    const int exit_code = report();
    if (as_json) report_as_json();
    return exit_code;
  } catch (...) {
    write_diagnostics("coordreq: error: the system gave no more memory\n");
    return static_cast<int>(ExitCode::limit);
  }
}

}  // namespace coordreq
