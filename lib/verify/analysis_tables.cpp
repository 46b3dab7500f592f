#include "verify/analysis_tables.hpp"

#include "base/requires.hpp"
#include "model/odometer.hpp"
#include "reach/table_shapes.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

PostTable AnalysisTables::empty(std::size_t state, const std::vector<std::int64_t>& cells) const {
  PostTable table = empty_table(grid_, inputs_, influences_on(spec_, state), cells);
  table.exact = false;
  return table;
}

PostTable AnalysisTables::posts(std::size_t state) {
  if (!cells_.empty()) {
    look_at_cells();
    return posts_[state];
  }
  PostTable table = empty(state, cells_);
  table.entries = written_out(whole(), state).entries;
  return table;
}

PostTable AnalysisTables::tubes(std::size_t state) {
  REQUIRES(spec_.abstraction.between_samples);
  if (cells_.empty()) return whole_tubes(state);
  look_at_cells();
  return tubes_[state];
}

PostTable AnalysisTables::whole_tubes(std::size_t state) {
  REQUIRES(spec_.abstraction.between_samples);
  const Abstraction tubes{.grid = grid_, .inputs = inputs_, .tables = whole().tubes};
  PostTable table = empty(state, {});
  table.entries = written_out(tubes, state).entries;
  return table;
}

void AnalysisTables::look_at_cells() {
  if (!posts_.empty()) return;
  for (std::size_t i = 0; i < grid_.size(); ++i) posts_.push_back(empty(i, cells_));
  if (source_.has_tubes()) {
    check_between_samples(spec_);
    tubes_ = posts_;
  }
  for (const std::int64_t cell : cells_) {
    source_.move_to(cell);
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const std::vector<std::size_t>& used = posts_[i].inputs;
      std::vector<std::int64_t> counts;
      for (const std::size_t j : used) counts.push_back(inputs_[j].count());
      std::size_t entry = posts_[i].entry_of(grid_, cell);
      Odometer choice(counts);
      do {
        std::int64_t u = 0;
        for (std::size_t j = 0; j < used.size(); ++j) u += choice[j] * inputs_.stride(used[j]);
        posts_[i].entries[entry] = source_.raw(i, u);
        if (!tubes_.empty()) tubes_[i].entries[entry] = source_.raw_tube(i, u);
        ++entry;
      } while (choice.advance());
    }
  }
}

}  // namespace coordreq
