#pragma once

#include <string>

#include "base/json.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The guarantee in words; where safety is asked at samples of a continuous system, how often that is, and
/// how far the state that moves by the most cells gets in between: "samples: checked every 1 s only, for
/// every point of a cell; between, p1 moves up to 10 m". In continuous time
/// also which states jump at samples.
/// @param motion of motion_json()
[[nodiscard]] std::string guarantee_line(const std::string& guarantee, const Json& motion,
                                         const SystemSpec& spec);

/// The guarantee in words without motions; in continuous time also which states jump at samples.
[[nodiscard]] std::string guarantee_of_file(const std::string& guarantee, const SystemSpec& spec);

}  // namespace coordreq
