#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace coordreq {

/// Why a document breaks a schema, in words for its author.
struct SchemaViolation {
  std::string what;
  std::string pointer;  ///< JSON pointer of the place
};

/// The first violation that a walk down `schema` and `document` meets: in an object unknown keys, missing
/// keys, keys that exclude each other, then its members in turn.
///
/// Understands the keywords that schema.json uses; titles say what was expected. Validators name the keyword
/// that failed and, for alternatives, everything about every branch; this names the one thing to mend.
[[nodiscard]] std::optional<SchemaViolation> find_violation(const nlohmann::json& schema,
                                                            const nlohmann::json& document);

}  // namespace coordreq
