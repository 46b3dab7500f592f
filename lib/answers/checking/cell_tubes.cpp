#include "answers/checking/cell_tubes.hpp"

#include <algorithm>

namespace coordreq {

bool passes_saturation(const GridDimension& dimension, IndexRange raw) {
  const bool below = dimension.below == Outside::saturate && raw.first < 0;
  const bool above = dimension.above == Outside::saturate && raw.last >= dimension.count;
  return below || above;
}

Tubes make_tubes(const UniformGrid& grid, const InputSpace& inputs, const std::vector<PostTable>& tables,
                 const std::vector<std::uint8_t>& safe, const std::vector<std::uint8_t>& beyond) {
  Tubes tubes{.covering = make_posts(grid, inputs, tables),
              .inside = {safe.begin(), safe.end()},
              .beyond = {beyond.begin(), beyond.end()}};
  for (std::size_t i = 0; i < tables.size(); ++i) {
    auto& passes = tubes.passes.emplace_back();
    passes.reserve(tables[i].entries.size());
    for (const IndexRange& raw : tables[i].entries) passes.push_back(passes_saturation(grid[i], raw) ? 1 : 0);
  }
  return tubes;
}

void CellTubes::go_to(std::int64_t cell) {
  covering_.go_to(cell);
  inside_memory_.assign(covering_.memory_size(), PostMinima::kNotKnown);
  beyond_memory_ = inside_memory_;
  const Posts& posts = tubes_->covering;
  first_.clear();
  may_pass_ = false;
  for (std::size_t i = 0; i < posts.tables.size(); ++i) {
    const auto first = static_cast<std::int64_t>(posts.tables[i]->entry_of(*posts.grid, cell));
    first_.push_back(first);
    const auto begin = tubes_->passes[i].begin() + first;
    may_pass_ =
        may_pass_ || std::find(begin, begin + posts.input_choices[i], 1) != begin + posts.input_choices[i];
  }
}

bool CellTubes::passes(std::int64_t u) const {
  for (std::size_t i = 0; may_pass_ && i < first_.size(); ++i) {
    const std::int64_t offset = tubes_->covering.input_offset[i][static_cast<std::size_t>(u)];
    if (tubes_->passes[i][static_cast<std::size_t>(first_[i] + offset)] != 0) return true;
  }
  return false;
}

bool CellTubes::is_safe(std::int64_t u) {
  const bool beyond = passes(u);
  return covering_.least(u, beyond ? tubes_->beyond : tubes_->inside, 0, 1,
                         beyond ? beyond_memory_ : inside_memory_) > 0;
}

}  // namespace coordreq
