#pragma once

#include <fmt/format.h>

#include <string>

#include "results/results_reader.hpp"

// Where a results file keeps what not every file holds.
namespace coordreq::paths {

inline constexpr char kController[] = "/controller";
/// The pairs of `controller.file`. No state can have this name.
inline constexpr char kListed[] = "/controller:file";
inline constexpr char kAgent[] = "/agent";
inline constexpr char kConventionFreedom[] = "/convention_freedom";
/// What agents may do by convention. No partition can have this name.
inline constexpr char kConvention[] = "/actions:convention";
inline constexpr char kAbstraction[] = "/abstraction";
inline constexpr char kMode[] = "/mode";
inline constexpr char kNetworkSafe[] = "/network_safe";
inline constexpr char kCoalition[] = "/coalition";
inline constexpr char kCriticalPair[] = "/critical_pair";
inline constexpr char kPair[] = "/pair";
inline constexpr char kRequirements[] = "/counterexample";

[[nodiscard]] inline std::string actions(const StoredPartition& partition) {
  return "/actions/" + partition.name;
}
[[nodiscard]] inline std::string actions(const StoredPartition& partition, std::size_t class_number) {
  return actions(partition) + "/" + partition.classes[class_number];
}
[[nodiscard]] inline std::string layers(const StoredPartition& partition) {
  return fmt::format("/layers/{}", partition.name);
}
[[nodiscard]] inline std::string convention(const std::string& agent) {
  return fmt::format("{}/{}", kConvention, agent);
}
/// @param end "first" or "last"
[[nodiscard]] inline std::string abstraction(const std::string& state, const std::string& end) {
  return fmt::format("{}/{}/{}", kAbstraction, state, end);
}

/// @param requirement its position among the requirements
[[nodiscard]] inline std::string counterexample(std::size_t requirement) {
  return fmt::format("{}/{}", kRequirements, requirement);
}

}  // namespace coordreq::paths
