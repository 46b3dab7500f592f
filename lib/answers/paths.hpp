#pragma once

#include <cstddef>
#include <string>

#include "spec/spec_types.hpp"

/// The paths of the datasets that more than one file knows by name; docs/reference/fields.md lists all. Those
/// in groups are defined beside their fields.
namespace coordreq::paths {

inline constexpr char kSafe[] = "/safe";
inline constexpr char kInvariant[] = "/invariant";
inline constexpr char kCollisionTime[] = "/collision_time";
inline constexpr char kController[] = "/controller";
/// The pairs of `controller.file`. No state can have this name.
inline constexpr char kListed[] = "/controller:file";

inline constexpr char kDelay[] = "/delay";
inline constexpr char kTrigger[] = "/trigger";
[[nodiscard]] std::string layers(const PartitionSpec& partition);
[[nodiscard]] std::string actions(const ProblemSpec& spec, const PartitionSpec& partition,
                                  std::size_t class_number);

inline constexpr char kArrival[] = "/arrival";
inline constexpr char kApproachDelay[] = "/approach_delay";
inline constexpr char kApproachTrigger[] = "/approach_trigger";
/// The progress controller, on request.
inline constexpr char kProgress[] = "/controller:goal";

inline constexpr char kCoalition[] = "/coalition";
inline constexpr char kCriticalPair[] = "/critical_pair";
inline constexpr char kNetworkSafe[] = "/network_safe";
inline constexpr char kConventionFreedom[] = "/convention_freedom";
/// The actions of an agent under the convention. No partition can have a name like this, with a colon.
[[nodiscard]] std::string convention(const AgentSpec& agent);

inline constexpr char kBlindDelay[] = "/blind_delay";
inline constexpr char kBlindCountdown[] = "/blind_countdown";
inline constexpr char kSilentLayer[] = "/silent_layer";
/// The table of a class, if has_silent_table().
[[nodiscard]] std::string silent(const ProblemSpec& spec, const PartitionSpec& partition,
                                 std::size_t class_number);

inline constexpr char kSilence[] = "/silence";
inline constexpr char kSilenceSet[] = "/silence_set";

inline constexpr char kRisk[] = "/risk";
inline constexpr char kDrawnRisk[] = "/risk_drawn";  ///< where the mode of the first step is drawn

}  // namespace coordreq::paths
