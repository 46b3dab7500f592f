#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/outside.hpp"
#include "model/table_shape.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// For each state about how far its next index is from the present one, at the most either way: its equation
/// over the whole domain, for one period. Proves nothing; for estimates.
[[nodiscard]] std::vector<IndexRange> usual_offsets(const SystemSpec& spec);

/// For each state by about how many indices the two ends of a post are apart, at the most: its equation over
/// the cell in the middle of the domain, under the middle inputs. Proves nothing either.
[[nodiscard]] std::vector<std::int32_t> usual_widths(const SystemSpec& spec);

/// The rows of a table along one state: the number of segments, whose cells all move alike or to the same
/// place, and the number of different rows.
struct UsualSlices {
  double segments = 1;   ///< of a row
  double different = 1;  ///< rows, of all choices of other states and inputs that the table depends on
};
/// Draws rows, the same ones whenever it is asked, and encloses their posts roughly. Proves nothing; for
/// estimates, on the high side where most drawn rows are different.
/// @param shape of the table of `state` @param along the state along the rows, on which the table depends
[[nodiscard]] UsualSlices usual_slices(const SystemSpec& spec, std::size_t state, const TableShape& shape,
                                       std::size_t along);

}  // namespace coordreq
