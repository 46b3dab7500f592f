#include <csignal>

#include "app/interrupt.hpp"
#include "app/mpi/mpi_ranks.hpp"
#include "app/mpi/on_ranks.hpp"
#include "app/report_error.hpp"
#include "app/standard_streams.hpp"

namespace {

/// The first rank answers signals for all: they end with it.
void obey_signals(bool is_first) {
  if (is_first) return coordreq::install_interrupt_handlers();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) std::signal(signal, SIG_IGN);
}

}  // namespace

int main(int argc, char** argv) {
  coordreq::share_heaps();
  coordreq::hold_standard_streams();
  coordreq::report_what_terminates();
  coordreq::MpiRanks ranks(argc, argv);
  obey_signals(ranks.rank() == 0);
  ranks.set_watch([] {
    if (coordreq::is_interrupted()) throw coordreq::interruption();
  });
  const bool as_json = coordreq::asks_for_json(argc, argv);
  try {
    const coordreq::ExitCode code = coordreq::analyze_on_ranks(argc, argv, ranks, [&ranks] { ranks.poll(); });
    ranks.finish();
    return static_cast<int>(code);
  } catch (const coordreq::ClosedPipe&) {
    ranks.end_all(static_cast<int>(coordreq::ExitCode::input_output), "the output is not read", [] {});
  } catch (...) {
    if (ranks.rank() == 0) ranks.end_all(coordreq::report_current_exception(as_json), "", [] {});
    const coordreq::Failure failure = coordreq::describe_current_exception();
    ranks.end_all(failure.exit_code, failure.what, [&] { coordreq::report_failure("a rank", failure); });
  }
}
