#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include "app/command_line.hpp"
#include "app/interrupt.hpp"
#include "app/report_error.hpp"
#include "app/standard_streams.hpp"

namespace {

/// Else each thread takes memory from a separate heap, and what one gives back the others cannot use: three
/// vehicles took a third to a half more with sixteen threads than with two.
void share_heaps() {
#if defined(M_ARENA_MAX)
  constexpr int kHeaps = 4;
  mallopt(M_ARENA_MAX, kHeaps);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  share_heaps();
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
