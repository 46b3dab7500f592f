#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/countdown/kinds.hpp"
#include "answers/field.hpp"
#include "answers/field_source.hpp"
#include "base/json.hpp"
#include "spec/spec_types.hpp"

// What the results file, summaries and `info` have of every kind of countdown.
namespace coordreq {

/// The most layers that are possible: each but the last loses a cell. @param losses the most layers that can
/// differ from the one before them
[[nodiscard]] std::uint64_t most_layers(const ProblemSpec& spec, std::uint64_t losses);
/// The fields `PREFIXlayer`, `PREFIXlayer_size`, `PREFIXfixed_point_index`: how many cells layers have,
/// constant once fixed, and F. @param losses as in most_layers()
void add_sizes(Fields& fields, const CountdownKind& kind, std::uint64_t losses, const ProblemSpec& spec);
/// The field of delays, or of triggers, of all partitions. @param fixed_points Field::fixed_points
[[nodiscard]] Field steps_field(const std::string& name, const ProblemSpec& spec, std::int64_t least,
                                std::vector<FieldAttribute> attributes, FieldDisplay display,
                                std::string fixed_points = {});

/// [partition] The layers of a kind of countdown.
using LayersOfPartitions = std::vector<const DelayLayers*>;
[[nodiscard]] LayersOfPartitions pointers_to(const std::vector<DelayLayers>& partitions);
/// The largest finite delay of all partitions.
[[nodiscard]] std::int64_t longest_delay(const LayersOfPartitions& partitions);
void fill_sizes(const LayersOfPartitions& partitions, const CountdownKind& kind, FieldValues& values);
/// The delays of all partitions, and their triggers if these have a path. The arrays refer to the answers.
/// @param finish changes the array of a partition; may be empty
void fill_steps(const Answers& answers, const LayersOfPartitions& partitions, const std::string& delay,
                const std::string& trigger, FieldValues& values,
                const std::function<ResultArray(ResultArray)>& finish = {});

/// The members of layers in the summary, beside their partition: F, sizes, unbounded cells, whether
/// `max_delay` cut them, a best state. Together.
[[nodiscard]] Json layers_json(const AnalysisContext& context, const DelayLayers& layers);
/// Adds the same members of the layers in a file, for all partitions.
/// @throws ResultsError if an F is no layer
void describe_layers(const ProblemSpec& spec, const FieldSource& source, const CountdownKind& kind,
                     Json& info);

}  // namespace coordreq
