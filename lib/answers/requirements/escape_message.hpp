#pragma once

#include <cstdint>

#include "answers/requirements/escape_path.hpp"
#include "answers/requirements/real_run.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// The place of the system itself after a step of an escape; beyond a `safe` side it is in all sets.
struct Reached {
  RealRun::Place place;
  bool is_inside = false;  ///< in K, or for silence in K'
  bool is_safe = false;
};

/// The progress of an escape in one step, as the process that owns its cell sends it to the others.
struct EscapeProgress {
  bool goes_on = false;
  bool has_more = false;  ///< there are equal steps that the system itself can follow
  std::int64_t way = 0;
  Reached reached;
};

/// A message with the step. @param inputs, cells numbers of joint inputs and cells of the path before the
/// step
[[nodiscard]] Bytes escape_message(const EscapeProgress& progress, const EscapePath& path, std::size_t inputs,
                                   std::size_t cells);
/// Reads a message, and adds the step to the path.
[[nodiscard]] EscapeProgress read_escape_message(const Bytes& message, EscapePath& path);

}  // namespace coordreq
