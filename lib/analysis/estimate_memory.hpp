#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/process_memory.hpp"
#include "engine/engine_sizes.hpp"
#include "model/model.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// About the most that this process will hold at a time if it analyses the problem now, in bytes: what it
/// holds already, with the spec as it was read, and what the types that will hold the rest report of
/// themselves. More rather than less. Counterexamples of usual length and steps that fit 8 bits are taken for
/// granted.
/// @param threads that will work, none of which is there yet; 0: all usable processors
[[nodiscard]] double estimate_memory(const Model& model, int threads);

/// estimate_memory() of one of several processes that share the work.
/// @param before bytes that the process holds before the work, see memory_of_program()
[[nodiscard]] double estimate_memory_of_rank(const Model& model, int threads, double before,
                                             const RowFractions& fractions);
/// Memory of the MPI library, measured with Open MPI 4.1, in bytes.
inline constexpr double kMpiBytes = 11.0 * 1024 * 1024;
/// Memory of the buffers of a checkpoint, in bytes: a segment of a list, and the chunks that zlib holds.
inline constexpr double kCheckpointBytes = 4.5 * 1024 * 1024;

/// @param needed bytes @param by_whom "on the fullest of 8 ranks, ", or nothing
/// @throws LimitError with the two if more is needed than the limit
void check_memory_limit(const ProblemSpec& spec, double needed, double limit, const std::string& by_whom);

/// The number of threads that there is memory for, at most `threads`. @param threads 0: all usable processors
/// @param saves whether the work will be saved in a checkpoint now and then
/// @throws LimitError with the estimate if there is no room for one
[[nodiscard]] int threads_within(const Model& model, std::optional<std::uint64_t> limit, int threads,
                                 bool saves);

}  // namespace coordreq
