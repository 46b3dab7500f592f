#pragma once

#include <string>
#include <vector>

#include "answers/one_cell/policy.hpp"
#include "base/json.hpp"

namespace coordreq {

/// Sentences that say for how long silence is safe in a partition, one for each policy, in their order.
/// @param partition of the summary of analyze(), or of read_info()
/// @param document the whole of it
/// @param policies of headline_policies()
[[nodiscard]] std::vector<std::string> headlines(const Json& partition, const Json& document,
                                                 const std::vector<AnswerPolicy>& policies);

/// The same as indented lines, each with its end of line.
[[nodiscard]] std::string headline_lines(const Json& partition, const Json& document,
                                         const std::vector<AnswerPolicy>& policies);

}  // namespace coordreq
