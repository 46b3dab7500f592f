#pragma once

#include <cstdint>
#include <new>
#include <optional>

#include "base/error.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Gives a state that is not discrete a grid with steps `factor` times as long, on the same domain and
/// through one of its points; a ring keeps its period and gets the whole number of points that is next to
/// that. Nothing is done where not even two points would be left.
void regrid(StateSpec& state, const Rational& factor);

/// regrid() of all states, but for few points, which are what a state needs.
void coarsen(ProblemSpec& spec, std::int64_t factor);

/// The problem on a coarser grid, without what only asks more of the answer: K and the layers of one
/// partition up to Z_1 are left.
struct CoarseCopy {
  ProblemSpec spec;
  std::int64_t factor = 1;  ///< of steps; 1: the grid is that of the spec
};

/// The least coarse one with at most so many cells and entries of tables; nothing if there is none, or the
/// controller comes from a file, which has the cells of one grid.
/// @param partition that is left
[[nodiscard]] std::optional<CoarseCopy> coarse_copy(const ProblemSpec& spec, std::size_t partition,
                                                    std::int64_t most_cells, double most_entries);

/// `work()`; nothing if the problem that it changes cannot be computed, as with a state off its new grid,
/// or for want of memory.
template <class Work>
auto if_possible(const Work& work) -> std::optional<decltype(work())> {
  try {
    return work();
  } catch (const SpecError&) {
    return std::nullopt;
  } catch (const LimitError&) {
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

}  // namespace coordreq
