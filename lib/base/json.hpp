#pragma once

#include <nlohmann/json_fwd.hpp>

namespace coordreq {

/// Keys keep the order in which they are set.
using Json = nlohmann::ordered_json;

}  // namespace coordreq
