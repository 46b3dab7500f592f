#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"

namespace coordreq {

/// Why a document breaks a schema, in words for its author.
struct SchemaViolation {
  std::string what;
  std::string pointer;  ///< JSON pointer of the place
};

/// The first `most` violations that a walk down `schema` and `document` meets: in an object unknown keys, or
/// else missing keys, or else keys that exclude each other; then its members in turn. None if the document is
/// valid.
///
/// Understands the keywords of draft 7 that schema.json uses, and no others; titles say what was expected.
/// Validators of libraries name the keyword that failed and, for alternatives, everything about every branch;
/// this names the one thing to mend. That both agree on what is valid is tested.
[[nodiscard]] std::vector<SchemaViolation> find_violations(const SortedJson& schema,
                                                           const SortedJson& document, std::size_t most);
/// find_violations() of the schema of specs, spec_schema().
[[nodiscard]] std::vector<SchemaViolation> find_spec_violations(const SortedJson& document, std::size_t most);

}  // namespace coordreq
