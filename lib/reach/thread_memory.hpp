#pragma once

namespace coordreq {

/// What a thread takes while it encloses posts, in bytes: series and boxes, and what the allocator
/// sets aside for them. Measured with flows.
inline constexpr double kBytesOfPostThread = 320.0 * 1024;

}  // namespace coordreq
