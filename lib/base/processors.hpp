#pragma once

#include <string>

namespace coordreq {

/// Processors that this process may use, at least 1: those of its affinity, and no more than the quota of its
/// control group and of those around it, rounded up (versions 1 and 2).
[[nodiscard]] int usable_processors();
/// The quota of the control groups that `own`, the text of /proc/self/cgroup, names, and of those around
/// them, in processors; infinite if there is none. @param root where the control groups are mounted,
/// /sys/fs/cgroup
[[nodiscard]] double processor_quota(const std::string& own, const std::string& root);

}  // namespace coordreq
