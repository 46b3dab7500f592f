#pragma once

#include <string>

namespace coordreq {

/// The problem with `silence`, drawn inside a RapidCheck property: conditions for some agents or all of them,
/// over their inputs and states that are measured without an error, and `then` or not. Often a condition
/// permits nothing somewhere, or what `allow` forbids.
[[nodiscard]] std::string with_silence(const std::string& problem);

}  // namespace coordreq
