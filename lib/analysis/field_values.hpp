#pragma once

#include "answers/field.hpp"
#include "results/result_content.hpp"

namespace coordreq {

/// The same as values of fields. The arrays refer to `content`, which must outlive the writing.
[[nodiscard]] FieldValues field_values(const ResultContent& content);

}  // namespace coordreq
