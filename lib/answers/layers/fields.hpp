#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {
namespace paths {

inline constexpr char kDelay[] = "/delay";
inline constexpr char kTrigger[] = "/trigger";
[[nodiscard]] std::string layers(const PartitionSpec& partition);
[[nodiscard]] std::string actions(const ProblemSpec& spec, const PartitionSpec& partition,
                                  std::size_t class_number);

}  // namespace paths

/// The fields `PREFIXlayer`, `PREFIXlayer_size`, `PREFIXfixed_point_index`: how many cells layers have,
/// constant once fixed, and F. @param layer what layers are called: "Z"
/// @param losses the most layers that can differ from the one before them
void add_sizes(Fields& fields, const std::string& prefix, char layer, std::uint64_t losses,
               const ProblemSpec& spec);
void fill_sizes(const std::vector<const DelayLayers*>& partitions, const std::string& prefix,
                FieldValues& values);
[[nodiscard]] std::vector<const DelayLayers*> pointers_to(const std::vector<DelayLayers>& partitions);
/// Type of the delays of all partitions, which share an array.
[[nodiscard]] ElementType delay_type(const std::vector<DelayLayers>& partitions);
/// `length` elements of the field of delays, or of triggers, of one partition.
/// @param fixed_points Field::fixed_points
[[nodiscard]] Field steps_field(const std::string& name, const ProblemSpec& spec, std::int64_t least,
                                std::vector<FieldAttribute> attributes, FieldShown shown,
                                std::string fixed_points = {});

}  // namespace coordreq
