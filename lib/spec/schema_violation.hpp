#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace coordreq {

/// Why a document breaks a schema, in words for its author.
struct SchemaViolation {
  std::string what;
  std::string pointer;  ///< JSON pointer of the place
};

/// The first violation that a walk down `schema` and `document` meets: in an object unknown keys, missing
/// keys, keys that exclude each other, then its members in turn. Nothing if the document is valid.
///
/// Understands the keywords of draft 7 that schema.json uses, and no others; titles say what was expected.
/// Validators of libraries name the keyword that failed and, for alternatives, everything about every branch;
/// this names the one thing to mend. That both agree on what is valid is tested.
[[nodiscard]] std::optional<SchemaViolation> find_violation(const nlohmann::json& schema,
                                                            const nlohmann::json& document);

}  // namespace coordreq
