#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/json.hpp"
#include "mutated_spec.hpp"
#include "spec/read_spec.hpp"
#include "spec/schema_violation.hpp"

namespace coordreq {
namespace {

/// What a validator that knows nothing of this program makes of the schema.
class OtherJudge {
 public:
  explicit OtherJudge(const SortedJson& schema) {
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), schema_);
  }
  [[nodiscard]] bool accepts(const SortedJson& document) const {
    return valijson::Validator().validate(schema_, valijson::adapters::NlohmannJsonAdapter(document),
                                          nullptr);
  }

 private:
  valijson::Schema schema_;
};

TEST(SchemaViolation, IsFoundWhereAnotherValidatorFindsOne) {
  const SortedJson schema = SortedJson::parse(spec_schema());
  const OtherJudge other(schema);
  EXPECT_TRUE(other.accepts(SortedJson::parse(test::kMaximalSpec, nullptr, true, true)));
  EXPECT_TRUE(rc::check("both judge alike", [&] {
    const SortedJson document = test::mutated_spec();
    RC_LOG() << document.dump();
    const bool is_valid = other.accepts(document);
    RC_CLASSIFY(is_valid, "valid");
    RC_ASSERT(find_violations(schema, document, 1).empty() == is_valid);
  }));
}

}  // namespace
}  // namespace coordreq
