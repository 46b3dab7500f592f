#pragma once

#include <cstddef>
#include <string>

#include "base/json.hpp"
#include "spec/spec_types.hpp"

// An analysis in words, from the summary of analyze().
namespace coordreq {

/// The text of `analyze`.
[[nodiscard]] std::string summary_text(const Json& summary, const ProblemSpec& spec);

/// Up to so many partitions are told in full; more get one line each of a table.
inline constexpr std::size_t kMostPartitionsInFull = 3;
/// They are not in a table, and there is something to say of them.
[[nodiscard]] bool tells_partitions_in_full(const Json& summary);

/// Figures of a partition in tables: F, |Z_F|, and the largest delay of the cells that have a finite one,
/// which is empty if none has.
[[nodiscard]] std::string fixed_point_text(const Json& partition);
[[nodiscard]] std::string unbounded_text(const Json& partition);
[[nodiscard]] std::string longest_delay_text(const Json& partition, const Json& summary);

/// The wall time of all stages.
[[nodiscard]] double seconds_of(const Json& summary);

}  // namespace coordreq
