#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "base/json.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Values of the inputs of a joint action of a class: row-major over its inputs, the last fastest.
[[nodiscard]] std::vector<Rational> values_of(const ProblemSpec& spec,
                                              const std::vector<std::int32_t>& inputs, std::size_t action);

/// An attribute that the spec tells. @pre the field has it
[[nodiscard]] std::int64_t integer_attribute(const Field& field, const std::string& name);

/// The meaning of a word of the flags, see FieldAsked::meanings.
[[nodiscard]] std::string status_words(const Field& field, const std::string& status);
/// A value of a document by its key, which stands beside its `KEY_status`. @param steps_text of steps
[[nodiscard]] std::string value_words(const Field& field, const Json& of, const std::string& key,
                                      const std::function<std::string(const Json& steps)>& steps_text);

}  // namespace coordreq
