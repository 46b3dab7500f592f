#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "abstraction/abstraction.hpp"
#include "bitset/row_bytes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// What of an abstraction has to be stored, besides the spec, to have it again: a few numbers that say how
/// the tables are made, and the lists in them.
struct SavedTables {
  std::vector<std::uint64_t> numbers;
  std::vector<RowBytes> lists;  ///< refer to the abstraction
};

[[nodiscard]] SavedTables save_tables(const Abstraction& abstraction);

/// The abstraction that `numbers` are of, with its lists to be filled.
/// @param read fills the next list, in their order: its address and how many bytes
/// @throws ResultsError if the numbers do not fit the spec
[[nodiscard]] Abstraction load_tables(const ProblemSpec& spec, const std::vector<std::uint64_t>& numbers,
                                      const std::function<void(std::byte* out, std::uint64_t bytes)>& read);

}  // namespace coordreq
