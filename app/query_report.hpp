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
  std::vector<const Field*> numbers;    ///< over cells alone, or over partitions and cells
  std::vector<const Field*> others;     ///< that have sections of their own

  [[nodiscard]] const ProblemSpec& spec() const { return results.spec(); }
  [[nodiscard]] static bool is_of_partitions(const Field& field) {
    return field.axes.front() == "/partition";
  }
};

/// Prints what `query` has found of a state.
void print_state(const CommonOptions& asked, const StateAnswer& answer, const QueryForm& form);

/// An answer as a document, on one line, in words. @param state that was asked for
[[nodiscard]] Json answer_json(const StateAnswer& answer, const QueryForm& form);
/// @param extra what stood beside the state, under the key `extra`; null: is not told
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

/// An attribute that the spec tells. @pre the field has it
[[nodiscard]] std::int64_t integer_attribute(const Field& field, const std::string& name);

/// The meaning of a word of the flags, see FieldQuery::meanings.
[[nodiscard]] std::string status_words(const Field& field, const std::string& status);
/// A value of a document by its key, which stands beside its `KEY_status`. @param steps_text of steps
[[nodiscard]] std::string value_words(const Field& field, const Json& of, const std::string& key,
                                      const std::function<std::string(const Json& steps)>& steps_text);

}  // namespace coordreq
