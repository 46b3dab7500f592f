#pragma once

#include <string>
#include <vector>

namespace coordreq {

/// A hint at something that is no error and can mislead: a result that shows the grid rather than the system,
/// a name that is not used. It never changes a result.
struct Warning {
  std::string kind;  ///< "grid", "unused", "units", "motion", "standing", ...: docs/how-to/grids.md says what
                     ///< each means
  std::string pointer;  ///< JSON pointer
  std::string text;     ///< one line
};
using Warnings = std::vector<Warning>;

}  // namespace coordreq
