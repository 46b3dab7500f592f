#include "app/program_help.hpp"
#include "app/report_error.hpp"
#include "app/standard_streams.hpp"
#include "results/version.hpp"

// Run by the build: prints coordreq(1).
int main() {
  try {
    coordreq::write_output(coordreq::man_page(coordreq::program_help(), coordreq::program_version()));
    return 0;
  } catch (...) {
    return coordreq::report_current_exception();
  }
}
