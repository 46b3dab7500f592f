#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "answers/ground.hpp"
#include "ranks/row_share.hpp"

// The ground of several processes: whose rows are whose, and the halo that each holds of others.
namespace coordreq {

/// Before the rows are cut.
[[nodiscard]] RowShare nothing_owned(Ranks& ranks);

/// Cuts the rows, if that is still to be done, and finds S in those held. Together.
/// @param find_safe adds S in some rows
/// @pre unchecked: there are engine and hull
void share_ground(Ground& ground, bool is_cut,
                  const std::function<void(const std::vector<RowShare::Range>&)>& find_safe);

/// Rows that a process would own, and hold of others.
struct RankRows {
  std::int64_t own = 0;
  std::int64_t halo = 0;
  std::vector<double> slices = {};  ///< RowPart::slices
};
/// Of so many processes, on an abstraction that is there. Halos are those of all cells, of S or not.
[[nodiscard]] std::vector<RankRows> rows_of_ranks(const Ground& ground, int ranks);

}  // namespace coordreq
