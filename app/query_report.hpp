#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "app/options.hpp"
#include "base/json.hpp"
#include "cell/state_query.hpp"
#include "cell/state_reader.hpp"
#include "numeric/rational.hpp"
#include "results/results_reader.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The columns and members of answers about states of a file.
struct QueryForm {
  /// @pre unchecked: `results` outlives this object.
  explicit QueryForm(const ResultsReader& results);

  const ResultsReader& results;
  std::vector<AnswerPolicy> policies;   ///< of classes
  std::vector<AnswerPolicy> of_agents;  ///< of agents
  std::vector<const Field*> numbers;    ///< by cell alone, or by partition and cell
  std::vector<const Field*> others;     ///< that have separate sections

  [[nodiscard]] const ProblemSpec& spec() const { return results.spec(); }
  [[nodiscard]] static bool is_of_partitions(const Field& field) {
    return field.axes.front() == "/partition";
  }
};

/// Prints what `query` has found of a state.
void print_state(const CommonOptions& args, const StateAnswer& answer, const QueryForm& form);

/// An answer as a document, on one line, as text. @param state of the query
[[nodiscard]] Json answer_json(const StateAnswer& answer, const QueryForm& form);
/// @param extra what stood beside the state, under the key `extra`; null: left out
[[nodiscard]] std::string answer_json_line(const StateAnswer& answer, const QueryForm& form,
                                           const std::vector<StateReader::Extra>* extra);
[[nodiscard]] std::string answer_text(const Json& answer, const std::vector<Rational>& state,
                                      const QueryForm& form);

/// The line of column names, and a line with an answer; what stood beside the state comes last.
[[nodiscard]] std::string answer_csv_header(const QueryForm& form, const std::vector<std::string>& extra);
[[nodiscard]] std::string answer_csv_line(const StateAnswer& answer, const QueryForm& form,
                                          const std::vector<StateReader::Extra>& extra);

/// Values of the inputs of a joint action of a class: row-major over its inputs, the last fastest.
[[nodiscard]] std::vector<Rational> values_of(const ProblemSpec& spec,
                                              const std::vector<std::int32_t>& inputs, std::size_t action);

/// An attribute that the spec gives. @pre the field has it
[[nodiscard]] std::int64_t integer_attribute(const Field& field, const std::string& name);

/// The meaning of a name of the flags, see FieldQuery::meanings.
[[nodiscard]] std::string status_text(const Field& field, const std::string& status);
/// A value of a document by its key, which stands beside its `KEY_status`. @param steps_text of steps
[[nodiscard]] std::string value_text_of(const Field& field, const Json& of, const std::string& key,
                                        const std::function<std::string(const Json& steps)>& steps_text);

}  // namespace coordreq
