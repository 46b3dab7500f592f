#include "app/report_error.hpp"

#include <new>
#include <string>
#include <string_view>

#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

void print(std::string_view prefix, std::string_view what) {
  write_diagnostics("coordreq: error: " + std::string(prefix) + printable(what) + "\n");
}

int report() {
  try {
    throw;
  } catch (const Error& error) {
    print("", error.what());
    return static_cast<int>(error.exit_code());
  } catch (const std::bad_alloc&) {
    // No string is built here: there may be no memory for one.
    write_diagnostics(
        "coordreq: error: the system gave no more memory; make the grids coarser, or find the need with "
        "\"coordreq validate\"\n");
    return static_cast<int>(ExitCode::limit);
  } catch (const std::exception& error) {
    print("internal error, please report it: ", error.what());
    return kInternalError;
  } catch (...) {
    print("internal error, please report it: ", "an exception of unknown type");
    return kInternalError;
  }
}

}  // namespace

int report_current_exception() noexcept {
  try {
    return report();
  } catch (...) {
    write_diagnostics("coordreq: error: the system gave no more memory\n");
    return static_cast<int>(ExitCode::limit);
  }
}

}  // namespace coordreq
