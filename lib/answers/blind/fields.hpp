#pragma once

#include <cstddef>
#include <string>

#include "answers/answers.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kBlindDelay[] = "/blind_delay";
inline constexpr char kBlindCountdown[] = "/blind_countdown";
inline constexpr char kSilentLayer[] = "/silent_layer";
/// The path of the table of a class, if has_silent_table().
[[nodiscard]] std::string silent(const ProblemSpec& spec, const PartitionSpec& partition,
                                 std::size_t class_number);

}  // namespace paths

/// The class is one of several, and does not see all states.
[[nodiscard]] bool has_silent_table(const ProblemSpec& spec, const PartitionSpec& partition,
                                    std::size_t class_number);

/// B of a partition; Z if it has one class. @pre unchecked: the layers have been found
[[nodiscard]] const DelayLayers& blind_layers(const Answers& answers, std::size_t p);
/// B with the levels of blind delays; Z if the partition has one class.
[[nodiscard]] const DelayLayers& blind_delays(const Answers& answers, std::size_t p);

}  // namespace coordreq
