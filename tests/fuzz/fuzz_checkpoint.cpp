// Checkpoints: an analysis that shall be taken up from the input.
#include <nlohmann/json.hpp>

#include "analysis/analyze.hpp"
#include "base/thread_team.hpp"
#include "fuzz/target.hpp"
#include "spec/read_spec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  static const ProblemSpec spec = read_spec(std::string(test::small_spec()), "small");
  static ThreadTeam team(1);
  const test::InputFile file(data, size);
  test::answers([&] {
    AnalysisOptions options;
    options.checkpoint = CheckpointOptions{.file = file.path(), .resume = true};
    (void)analyze(spec, options, team);
  });
  return 0;
}
