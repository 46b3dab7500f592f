#pragma once

#include <string>

#include "results/results_reader.hpp"

// Where a results file keeps what is stored on request.
namespace coordreq::paths {

inline constexpr char kController[] = "/controller";
/// The pairs of `controller.file`. No state can have this name.
inline constexpr char kListed[] = "/controller:file";
inline constexpr char kAbstraction[] = "/abstraction";
inline constexpr char kRequirements[] = "/counterexample";

[[nodiscard]] inline std::string actions(const StoredPartition& partition) {
  return "/actions/" + partition.name;
}
[[nodiscard]] inline std::string actions(const StoredPartition& partition, std::size_t class_number) {
  return actions(partition) + "/" + partition.classes[class_number];
}
[[nodiscard]] inline std::string layers(const StoredPartition& partition) {
  return "/layers/" + partition.name;
}
/// @param end "first" or "last"
[[nodiscard]] inline std::string abstraction(const std::string& state, const std::string& end) {
  return std::string(kAbstraction) + "/" + state + "/" + end;
}

/// @param requirement its position among the requirements
[[nodiscard]] inline std::string counterexample(std::size_t requirement) {
  return std::string(kRequirements) + "/" + std::to_string(requirement);
}

}  // namespace coordreq::paths
