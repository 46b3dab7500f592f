#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "cell/cell_controller.hpp"
#include "model/locate.hpp"
#include "numeric/rational.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Everything that a results file knows about one state.
struct StateAnswer {
  /// On the way to a goal.
  struct Approach {
    std::int32_t delay = 0;                  ///< steps, as `/approach_delay`
    std::int32_t trigger = 0;                ///< steps, as `/approach_trigger`
    std::vector<std::vector<bool>> actions;  ///< joint actions that come nearer, [class][action]; none in G
  };
  struct Partition {
    std::int32_t delay = 0;                  ///< steps, as ResultsReader::delay()
    std::int32_t trigger = 0;                ///< steps, as ResultsReader::trigger()
    std::vector<std::vector<bool>> actions;  ///< admissible joint actions, [class][action]
    std::optional<Approach> approach;        ///< if the spec has a goal
  };
  std::vector<Rational> state;
  Location location;
  // The rest only where the location is a cell.
  bool safe = false;
  bool invariant = false;
  std::int32_t collision_time = 0;  ///< steps, as ResultsReader::collision_time()
  std::vector<Partition> partitions;
  struct Coalition {
    std::int32_t partition = 0;  ///< as ResultsReader::coalition()
    std::vector<std::size_t> critical_pairs;
  };
  std::optional<Coalition> coalition;  ///< if the file has a coalition map
  std::vector<bool> safe_modes;        ///< by mode of the network; none without one
  /// What the convention leaves each agent, [agent][action]; none without a convention.
  std::vector<std::vector<bool>> convention;
  std::vector<std::int32_t> others;  ///< of the fields of asked_fields()
};

/// The fields of the file that are told as FieldShown::asked says.
[[nodiscard]] std::vector<const Field*> asked_fields(const ResultsReader& results);

/// Answers questions about states. Not thread-safe.
class StateQuery {
 public:
  /// REQUIRES: `results` and `team` outlive this object.
  StateQuery(const ResultsReader& results, ThreadTeam& team)
      : results_(results), controller_(results, team) {}

  /// @param state one value a state of the spec. A state outside of the domain has an answer too.
  /// @throws ResultsError if the file is damaged, or needed actions are neither stored nor computable
  [[nodiscard]] StateAnswer at(std::vector<Rational> state);

 private:
  [[nodiscard]] StateAnswer::Approach approach_at(std::size_t partition, std::int64_t cell);
  [[nodiscard]] StateAnswer::Coalition coalition_at(const CellBlock& block) const;

  const ResultsReader& results_;
  CellController controller_;
};

/// The box of a cell: its lower and upper ends in every dimension, equal for a discrete one.
struct CellBox {
  std::vector<Rational> centre;
  std::vector<Rational> lower;
  std::vector<Rational> upper;
};
[[nodiscard]] CellBox box_of_cell(const UniformGrid& grid, std::int64_t cell);

}  // namespace coordreq
