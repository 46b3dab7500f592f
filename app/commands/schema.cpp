#include <memory>

#include "app/commands/all.hpp"
#include "app/standard_streams.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {

Run declare_schema(Options& options) {
  const auto own = std::make_shared<CommonOptions>();
  declare_common(options, *own);
  return [own] {
    write_output(spec_schema());
    return ExitCode::success;
  };
}

}  // namespace coordreq
