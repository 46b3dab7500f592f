#pragma once

#include <cstddef>
#include <vector>

#include "spec/problem_spec.hpp"

namespace coordreq {

/// The states in the order in which the engine works best; [dimension of the engine] index of the state.
///
/// 1. Rows run along a state that moves by an offset that does not depend on itself, if there is one: the
/// longest, and of equals the last. Then a whole row is one window.
/// 2. What moves with that state comes last, and before it what moves by itself, so that minima over the
/// leading dimensions are shared (RowEngine). States that move together stand together.
/// 3. But where motion is coupled and led by what moves by itself (RowEngine::is_summed), the leaders come
/// first and the sums behind them, the longest along the rows.
/// The order of the spec is kept where nothing is gained.
[[nodiscard]] std::vector<std::size_t> choose_layout(const ProblemSpec& spec);

/// True if that order is the one of sums: then these tables are not cut into rows.
[[nodiscard]] bool is_layout_of_sums(const ProblemSpec& spec);

/// True if what the spec asks for is read or written in rows along the last dimension alone.
[[nodiscard]] bool is_read_by_runs(const ProblemSpec& spec);

/// The same problem with its states in another order; the text stays as it is.
/// REQUIRES: `order` is a permutation of the states.
[[nodiscard]] ProblemSpec laid_out(const ProblemSpec& spec, const std::vector<std::size_t>& order);

}  // namespace coordreq
