#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "cell/cell_controller.hpp"
#include "model/locate.hpp"
#include "numeric/rational.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Everything that a results file knows about one state.
struct StateAnswer {
  std::vector<Rational> state;
  Location location;
  // The members below are set only where the location is a cell.
  /// By path, of S, K, collision times, the steps of policies and the fields of query_fields(): the value at
  /// the cell, or one for each entry of the leading axis.
  std::map<std::string, std::vector<std::int32_t>> values;
  /// By name of the policy: what it leaves the classes of each partition, [partition][class][action]; or, as
  /// if of one partition, each agent.
  std::map<std::string, std::vector<ActionSets>> actions;

  /// @param entry of the leading axis, if there is one. @pre there is such a value
  [[nodiscard]] std::int32_t value(const std::string& path, std::size_t entry = 0) const {
    REQUIRES(values.contains(path) && entry < values.at(path).size());
    return values.at(path)[entry];
  }
};

/// The fields of the file that are displayed as FieldQuery says, in the order of the answers, without the
/// steps of policies.
[[nodiscard]] std::vector<const Field*> query_fields(const ResultsReader& results);

/// Answers questions about states. Not thread-safe.
class StateQuery {
 public:
  /// @pre unchecked: `results` and `team` outlive this object.
  StateQuery(const ResultsReader& results, ThreadTeam& team)
      : results_(results), controller_(results, team), query_fields_(query_fields(results)) {}

  /// @param state one value a state of the spec. A state outside of the domain has an answer too.
  /// @throws ResultsError if the file is damaged, or needed actions are neither stored nor computable
  [[nodiscard]] StateAnswer at(std::vector<Rational> state);
  [[nodiscard]] const std::vector<AnswerPolicy>& policies() const { return controller_.policies(); }

 private:
  void read_values(const std::string& path, const CellBlock& block, StateAnswer& answer) const;

  const ResultsReader& results_;
  CellController controller_;
  std::vector<const Field*> query_fields_;
};

/// The box of a cell: its lower and upper ends in every dimension, equal for a discrete one.
struct CellBox {
  std::vector<Rational> centre;
  std::vector<Rational> lower;
  std::vector<Rational> upper;
};
[[nodiscard]] CellBox box_of_cell(const UniformGrid& grid, std::int64_t cell);

}  // namespace coordreq
