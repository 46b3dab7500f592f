#pragma once

namespace coordreq {

/// Memory of a thread that encloses posts, in bytes: series and boxes, with the reserve of the allocator.
/// Measured with flows.
inline constexpr double kBytesOfPostThread = 320.0 * 1024;

}  // namespace coordreq
