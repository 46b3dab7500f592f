#include "app/command_line.hpp"
#include "app/interrupt.hpp"
#include "app/report_error.hpp"
#include "app/standard_streams.hpp"
#include "base/process_memory.hpp"

int main(int argc, char** argv) {
  coordreq::share_heaps();
  const bool as_json = coordreq::asks_for_json(argc, argv);
  try {
    coordreq::hold_standard_streams();
    coordreq::install_interrupt_handlers();
    coordreq::report_what_terminates();
    const coordreq::Run run = coordreq::parse_command_line(argc, argv);
    return static_cast<int>(run());
  } catch (const coordreq::ClosedPipe&) {
    coordreq::end_by_closed_pipe();
  } catch (...) {
    return coordreq::report_current_exception(as_json);
  }
}
