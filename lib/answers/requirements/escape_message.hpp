#pragma once

#include <cstdint>

#include "answers/requirements/escape_path.hpp"
#include "answers/requirements/real_run.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// Where the system itself is after a step of an escape; beyond `safe` sides it is in all sets.
struct Reached {
  RealRun::Place place;
  bool is_inside = false;  ///< in K, or of silence in K'
  bool is_safe = false;
};

/// What a step adds to an escape, as the process that owns its cell tells the others.
struct EscapeProgress {
  bool goes_on = false;
  bool has_more = false;  ///< equal steps that the system itself can follow
  std::int64_t way = 0;
  Reached reached;
};

/// @param inputs, cells how many of them the path had before the step
[[nodiscard]] Bytes escape_message(const EscapeProgress& progress, const EscapePath& path, std::size_t inputs,
                                   std::size_t cells);
/// Adds it to the path of another process.
[[nodiscard]] EscapeProgress read_escape_message(const Bytes& message, EscapePath& path);

}  // namespace coordreq
