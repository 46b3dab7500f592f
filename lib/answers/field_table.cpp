#include "answers/field_table.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "answers/plan.hpp"

namespace coordreq {

Fields answer_fields(const ProblemSpec& spec) {
  Fields table;
  for (const Answer& answer : all_answers()) {
    Fields fields = answer.fields(spec);
    std::move(fields.begin(), fields.end(), std::back_inserter(table));
  }
  return table;
}

Fields result_fields(const ProblemSpec& spec) {
  // Within a section fields of later answers come first: files have always been written so.
  Fields table;
  const std::vector<Answer>& answers = all_answers();
  for (auto answer = answers.rbegin(); answer != answers.rend(); ++answer) {
    Fields fields = answer->fields(spec);
    std::move(fields.begin(), fields.end(), std::back_inserter(table));
  }
  std::stable_sort(table.begin(), table.end(),
                   [](const Field& a, const Field& b) { return a.section < b.section; });
  return table;
}

FieldValues computed_values(const Answers& answers, ThreadTeam& team) {
  FieldValues values;
  for (const Answer& answer : all_answers()) answer.fill(answers, team, values);
  return values;
}

std::optional<std::vector<std::uint64_t>> shape_of(const Field& field,
                                                   const std::map<std::string, std::uint64_t>& scales) {
  std::vector<std::uint64_t> shape;
  for (const std::string& axis : field.axes) {
    const auto scale = scales.find(axis);
    if (scale == scales.end()) return std::nullopt;
    shape.push_back(scale->second);
  }
  return shape;
}

}  // namespace coordreq
