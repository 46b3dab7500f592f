#include "app/commands.hpp"
#include "app/standard_streams.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {

ExitCode run_schema(const CommandLine&) {
  write_output(spec_schema());
  return ExitCode::success;
}

}  // namespace coordreq
