// Results files: opened and read as `query` and `export` do. Damaged files can crash the HDF5 library, which
// is why a child process tries first; each execution is a fork.
#include <algorithm>

#include "fuzz/target.hpp"
#include "model/cell_block.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  const test::InputFile file(data, size);
  test::answers([&] {
    const ResultsReader results(file.path());
    const std::int64_t end = std::min<std::int64_t>(results.grid().cells(), 1000);
    (void)results.read_run(0, end, [&](const CellBlock& block) { return results.members("/safe", block); });
    (void)results.read_run(0, end,
                           [&](const CellBlock& block) { return results.values("/collision_time", block); });
    for (std::size_t p = 0; p < results.partitions().size(); ++p) {
      (void)results.read_run(0, end,
                             [&](const CellBlock& block) { return results.values("/delay", p, block); });
      const PartitionSpec& partition = results.spec().coordination.partitions[p];
      if (results.spec().output.layers) (void)read_layer_lists(results.spec(), partition, results);
    }
  });
  return 0;
}
