#include <algorithm>

#include "answers/memory_need.hpp"
#include "reach/table_shapes.hpp"
#include "reach/thread_memory.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

MemoryNeed context_memory(const EngineSizes& sizes, int threads) {
  const Model& model = sizes.model();
  const ProblemSpec& spec = model.spec();
  MemoryNeed need{.kept = sizes.set() + sizes.hull(),
                  .work = sizes.set() + sizes.condition_of_held(spec.safe)};
  if (spec.ends_at_goal()) {
    need.kept += sizes.set();
    need.work = std::max(need.work, sizes.set() + sizes.condition_of_held(*spec.goal));
  }
  double slices = sizes.set() + sizes.hull();
  for (std::size_t t = 0; t < model.grid().size(); ++t) {
    slices += sizes.slices(t);
    need.kept += sizes.table(t) + sizes.slices(t);
    // Tables of tubes are as large as those of posts, and are cut into rows twice where states saturate.
    if (spec.abstraction.between_samples) need.kept += sizes.table(t) + 2 * sizes.slices(t);
    if (!spec.output.abstraction) continue;
    const double entries = choices_of(spec, model.shapes()[t].states, model.shapes()[t].inputs);
    need.array = std::max(need.array, entries * sizeof(std::int32_t));
    need.written = std::max(need.written, entries * sizeof(IndexRange));
  }
  // The allocator does not give back the memory that it has set aside for a thread.
  need.kept += (threads - 1) * kBytesOfPostThread;
  // Unsent entries are in memory before tables are cut into rows.
  const double tubes = spec.abstraction.between_samples ? 2 : 1;
  need.work = std::max(need.work, tubes * (sizes.unsent_entries() - slices));
  if (spec.abstraction.between_samples) need.kept += 2 * sizes.levels() + sizes.set();
  if (spec.controller.allow) {
    need.work += sizes.condition(*spec.controller.allow);
    need.kept += sizes.condition(*spec.controller.allow);
  }
  if (spec.controller.file) need.kept += sizes.packed_pairs(model.inputs().count()) + sizes.pair_table();
  return need;
}

}  // namespace coordreq
