#pragma once

#include "engine/level_map.hpp"
#include "engine/post_reader.hpp"
#include "engine/tuple_walk.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The controller C of an invariance set, contract "Controller": `maximal` C(x) = {u allowed : empty !=
/// f(x,u) subset of K}, `given` C(x) = {u allowed}; empty outside K. Never stored, computed row by row.
/// The paper's C, whose projections make IND_C (its Eq. (3) and (4)).
struct Controller {
  const RowEngine* engine = nullptr;
  const CellSet* invariant = nullptr;
  const LevelMap* collision_time = nullptr;  ///< kTop in `invariant` and nowhere else
  Synthesis synthesis = Synthesis::maximal;
};

/// {x in the row : u in C(x)} for all u in one choice of groups.
/// @param posts of the levels of controller.collision_time
/// REQUIRES: `out` has engine->row_words() words.
template <class Level>
void controller_row(const Controller& controller, std::int64_t row, TupleWalk& tuple,
                    PostReader<Level>& posts, MutableRow out) {
  const ConstRow invariant = controller.invariant->row(row);
  const ConstRow allowed = tuple.allowed();
  if (controller.synthesis == Synthesis::maximal) {
    const auto n = static_cast<std::size_t>(controller.engine->row_length());
    posts.kernels().top_bits(posts.minimum(tuple.slice_ids()), out.data(), n);
    for (std::size_t w = 0; w < out.size(); ++w) out[w] &= invariant[w];
  } else {
    std::copy(invariant.begin(), invariant.end(), out.begin());
  }
  for (std::size_t w = 0; w < allowed.size(); ++w) out[w] &= allowed[w];
}

}  // namespace coordreq
