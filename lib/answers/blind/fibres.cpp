#include "answers/blind/fibres.hpp"

#include "base/index.hpp"
#include "model/odometer.hpp"

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
  std::vector<std::int64_t> counts;
  for (std::size_t d = grid.across(); d < grid.size(); ++d) counts.push_back(grid[d].count);
  Odometer index(counts);
  do {
    std::int64_t lane = 0;
    std::int64_t fibre = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      lane += index[k] * grid.stride(grid.across() + k);
      fibre += index[k] * strides[grid.across() + k];
    }
    along_[at(lane)] = fibre;
  } while (index.advance());
}

}  // namespace coordreq
