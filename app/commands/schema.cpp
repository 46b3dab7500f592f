#include "app/commands/all.hpp"
#include "app/standard_streams.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {

Run declare_schema(Options& /*options*/) {
  return [] {
    write_output(spec_schema());
    return ExitCode::success;
  };
}

}  // namespace coordreq
