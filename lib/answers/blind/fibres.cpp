#include "answers/blind/fibres.hpp"

#include "base/index.hpp"

namespace coordreq {

Fibres::Fibres(const UniformGrid& grid, const std::vector<std::size_t>& seen) {
  std::vector<std::int64_t> strides(grid.size(), 0);  // by dimension
  for (std::size_t k = seen.size(); k-- > 0;) {
    const std::size_t d = grid.dimension_of(seen[k]);
    strides[d] = count_;
    count_ *= grid[d].count;
  }
  across_.assign(strides.begin(), strides.begin() + static_cast<std::ptrdiff_t>(grid.across()));
  along_.assign(at(grid.row_length()), 0);
  for (std::int64_t lane = 0; lane < grid.row_length(); ++lane) {
    std::int64_t fibre = 0;
    bool is_cell = true;
    for (std::size_t d = grid.across(); d < grid.size(); ++d) {
      const std::int64_t index = grid.index(lane, d);
      is_cell = is_cell && index < grid[d].count;
      fibre += index * strides[d];
    }
    if (is_cell) along_[at(lane)] = fibre;
  }
}

}  // namespace coordreq
