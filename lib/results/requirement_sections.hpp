#pragma once

#include <string>

#include "results/netcdf_writer.hpp"
#include "results/result_content.hpp"

namespace coordreq {

/// `/counterexample`, if there are requirements: their verdicts, and a group of its own for each that has a
/// path, by its position among the requirements.
void write_requirements(NetcdfWriter& file, const ResultContent& content);

/// "none below_x above_x below_y ...": the meanings of 0, 1, ... as a side of the domain.
[[nodiscard]] std::string side_meanings(const std::vector<std::string>& states);

/// The number of a side among these. @param states number of states
[[nodiscard]] std::int32_t side_number(const std::optional<ResultSide>& side);
[[nodiscard]] std::optional<ResultSide> side_of_number(std::int64_t number);

/// The words for EscapeEnd, after "none", and for EscapePhase.
inline constexpr char kEndMeanings[] =
    "none outside_safe_set left_domain unsafe_between_samples no_allowed_action";
inline constexpr char kPhaseMeanings[] = "independent evasive";

}  // namespace coordreq
