#include "spec/schema_check.hpp"

#include <optional>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/error.hpp"
#include "spec/read_spec.hpp"
#include "spec/schema_violation.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

bool is_valid(const nlohmann::json& schema_text, const nlohmann::json& document) {
  valijson::Schema schema;
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_text), schema);
  valijson::Validator validator;
  return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
}

}  // namespace

void check_schema(const JsonDocument& document) {
  const nlohmann::json schema = nlohmann::json::parse(spec_schema());
  if (is_valid(schema, document.value())) return;
  const std::optional<SchemaViolation> violation = find_violation(schema, document.value());
  if (violation) throw SpecError(violation->what, shown_pointer(violation->pointer));
  throw SpecError("does not follow the schema that `coordreq schema` prints", shown_pointer(""));
}

}  // namespace coordreq
