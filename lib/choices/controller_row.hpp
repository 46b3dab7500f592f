#pragma once

#include <algorithm>
#include <cstdint>

#include "base/requires.hpp"
#include "choices/controller.hpp"
#include "engine/level_map.hpp"
#include "engine/post_reader.hpp"
#include "engine/tuple_walk.hpp"

namespace coordreq {

/// The levels that those of posts must be above for an action to be in P.
/// @param levels controller.levels
template <class Level>
const LevelRows<Level>& bounds_of(const Controller& controller, const LevelRows<Level>& levels) {
  if (controller.bounds == nullptr) return levels;
  const auto* const bounds = controller.bounds->get_if<Level>();
  REQUIRES(bounds != nullptr);
  return *bounds;
}

/// out = {x in the row : u in C(x)}, the same for all u in one choice of groups.
/// @param posts of `levels`, which are controller.levels
/// @param lanes cells outside these lanes may be missing
/// @pre `out` has engine->row_words() words
template <class Level>
void controller_row(const Controller& controller, const LevelRows<Level>& levels, std::int64_t row,
                    TupleWalk& tuple, PostReader<Level>& posts, LaneRange lanes, MutableRow out) {
  REQUIRES(out.size() == controller.engine->row_words());
  const ConstRow invariant = controller.invariant->row(row);
  const ConstRow allowed = tuple.allowed();
  if (controller.synthesis == Synthesis::maximal) {
    const std::size_t word = lanes.begin / CellSet::kWordBits;
    lanes.begin = word * CellSet::kWordBits;
    const Level* const least = posts.minimum(tuple.slice_ids(), lanes, 0);
    std::fill(out.begin(), out.end(), 0);
    if (controller.approaches) {
      const Level* const bounds = bounds_of(controller, levels).row(row);
      posts.kernels().above_bits(least, bounds + lanes.begin, out.data() + word, lanes.size());
    } else {
      posts.kernels().top_bits(least, out.data() + word, lanes.size());
    }
    for (std::size_t w = 0; w < out.size(); ++w) out[w] &= invariant[w];
  } else {
    std::copy(invariant.begin(), invariant.end(), out.begin());
  }
  for (std::size_t w = 0; w < allowed.size(); ++w) out[w] &= allowed[w];
}

}  // namespace coordreq
