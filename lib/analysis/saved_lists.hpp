#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "answers/convention/convention_freedom.hpp"
#include "engine/row_bytes.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// What has to be stored of something, besides the spec, to have it again: a few numbers that say how it is
/// made, and the lists in it.
struct SavedLists {
  std::vector<std::uint64_t> numbers;
  std::vector<RowBytes> lists;  ///< refer to what is saved; a row each
};

/// Fills the next list, in the order of SavedLists::lists: its address and how many bytes it has.
using ReadList = std::function<void(std::byte* out, std::uint64_t bytes)>;

[[nodiscard]] SavedLists save(const Abstraction& abstraction);
[[nodiscard]] SavedLists save(const ConventionFreedom& freedom);

/// What `numbers` are of, its lists filled. @throws ResultsError if they do not fit
[[nodiscard]] Abstraction load_abstraction(const ProblemSpec& spec, const std::vector<std::uint64_t>& numbers,
                                           const ReadList& read);
/// @param cells of the grid
[[nodiscard]] ConventionFreedom load_convention(std::size_t agents, std::int64_t cells,
                                                const std::vector<std::uint64_t>& numbers,
                                                const ReadList& read);

}  // namespace coordreq
