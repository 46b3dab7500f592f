#pragma once

#include <functional>
#include <string_view>

namespace coordreq {

/// Takes an exported text piece by piece, in order; may throw.
using TextSink = std::function<void(std::string_view)>;

}  // namespace coordreq
