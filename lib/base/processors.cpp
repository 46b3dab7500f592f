#include "base/process_memory.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

namespace coordreq {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Processors by affinity; those of the machine where the system does not report them.
int allowed_processors() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) == 0) return CPU_COUNT(&allowed);
  return static_cast<int>(std::thread::hardware_concurrency());
}

/// "max" and -1, as what cannot be read, are no quota.
double quota(std::istream& limit, std::istream& period) {
  double most = 0;
  double length = 0;
  if (!(limit >> most) || !(period >> length) || most <= 0 || length <= 0) return kInfinity;
  return most / length;
}

double quota_of_folder(const std::string& folder) {
  std::ifstream both(folder + "/cpu.max");
  if (both) return quota(both, both);
  std::ifstream limit(folder + "/cpu.cfs_quota_us");
  std::ifstream period(folder + "/cpu.cfs_period_us");
  return quota(limit, period);
}

/// The least quota of the group at `path` and of all around it. A container may see its own group at the
/// root.
double least_quota(const std::string& root, std::string path) {
  double least = quota_of_folder(root);
  while (path.size() > 1) {
    least = std::min(least, quota_of_folder(root + path));
    path.resize(path.rfind('/'));
  }
  return least;
}

}  // namespace

double processor_quota(const std::string& groups, const std::string& root) {
  double least = kInfinity;
  std::istringstream lines(groups);
  // NUMBER:CONTROLLERS:PATH, without controllers in version 2
  for (std::string number, controllers, path; std::getline(lines, number, ':') &&
                                              std::getline(lines, controllers, ':') &&
                                              std::getline(lines, path);) {
    if (path.empty() || path.front() != '/') continue;
    if (controllers.empty()) {
      least = std::min(least, least_quota(root, path));
    } else if (("," + controllers + ",").find(",cpu,") != std::string::npos) {
      for (const std::string& mount : {"/" + controllers, std::string("/cpu")})
        least = std::min(least, least_quota(root + mount, path));
    }
  }
  return least;
}

int usable_processors() {
  std::ifstream groups("/proc/self/cgroup");
  std::ostringstream text;
  text << groups.rdbuf();
  const double most = std::ceil(processor_quota(text.str(), "/sys/fs/cgroup"));
  const int allowed = std::max(1, allowed_processors());
  return most < allowed ? std::max(1, static_cast<int>(most)) : allowed;
}

}  // namespace coordreq
