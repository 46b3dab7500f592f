#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Every dataset that a results file of this spec can have, axes before the fields over them, in the order of
/// the file.
[[nodiscard]] Fields result_fields(const ProblemSpec& spec);

/// All fields in the order of the answers.
[[nodiscard]] Fields answer_fields(const ProblemSpec& spec);

/// The values of all fields. The arrays refer to the answers, which must outlive the writing.
[[nodiscard]] FieldValues computed_values(const Answers& answers, ThreadTeam& team);

/// The lengths of the axes of a field. @param scales lengths by path. Nothing if one of the axes is not
/// there.
[[nodiscard]] std::optional<std::vector<std::uint64_t>> shape_of(
    const Field& field, const std::map<std::string, std::uint64_t>& scales);

}  // namespace coordreq
