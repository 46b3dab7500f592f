#include "app/query_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/render.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::vector<Rational> values_of(const ProblemSpec& spec, const std::vector<std::int32_t>& inputs,
                                std::size_t action) {
  std::vector<Rational> values(inputs.size());
  for (std::size_t j = inputs.size(); j-- > 0;) {
    const std::vector<Rational>& choices = spec.inputs[static_cast<std::size_t>(inputs[j])].values;
    values[j] = choices[action % choices.size()];
    action /= choices.size();
  }
  return values;
}

std::int64_t integer_attribute(const Field& field, const std::string& name) {
  const auto found =
      std::find_if(field.attributes.begin(), field.attributes.end(),
                   [&name](const FieldAttribute& attribute) { return attribute.name == name; });
  REQUIRES(found != field.attributes.end());
  return std::get<std::int64_t>(found->value);
}

std::string status_words(const Field& field, const std::string& status) {
  const auto& meanings = field.display.query.meanings;
  if (const auto found = meanings.find(status); found != meanings.end()) return found->second;
  return words_of(status);
}

std::string value_words(const Field& field, const Json& of, const std::string& key,
                        const std::function<std::string(const Json& steps)>& steps_text) {
  const std::string status = text_of(of[key + "_status"]);
  if (status == "number") return of[key].is_number_float() ? probability_text(of[key]) : grouped(of[key]);
  if (status == "at_least") return "at least " + steps_text(of[key]);
  if (status != "steps") return status_words(field, status);
  return of[key] == 0 && field.display.query.meanings.contains("0") ? status_words(field, "0")
                                                                    : steps_text(of[key]);
}

}  // namespace coordreq
