#include "abstraction/build_abstraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "abstraction/counter.hpp"
#include "abstraction/index_form.hpp"
#include "base/error.hpp"
#include "dynamics/affine_dynamics.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Fills the table of one state: for each choice of parameters and inputs one affine row, then all cells.
class TableBuilder {
 public:
  TableBuilder(const ProblemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
               std::size_t state)
      : spec_(spec),
        dynamics_(dynamics),
        grid_(abstraction.grid),
        inputs_(abstraction.inputs),
        dependencies_(dynamics.dependencies(state)),
        table_(abstraction.tables[state]),
        state_(state) {}

  /// @returns true if every row is exact
  bool build(ThreadTeam& team) {
    table_.states = dependencies_.moving;
    table_.states.insert(table_.states.end(), dependencies_.parameters.begin(),
                         dependencies_.parameters.end());
    std::sort(table_.states.begin(), table_.states.end());
    table_.inputs = dependencies_.inputs;
    table_.entries.resize(static_cast<std::size_t>(lay_out(table_, grid_, inputs_)));

    std::atomic<bool> exact = true;
    const Counter choices(choice_counts());
    team.for_each(choices.size(), 1, [&](ThreadTeam::Range range, int) {
      Counter choice = choices;
      choice.seek(range.begin);
      for (std::int64_t i = range.begin; i < range.end; ++i, choice.next()) {
        if (!fill(choice.indices())) exact = false;
      }
    });
    return exact;
  }

 private:
  [[nodiscard]] std::vector<std::int64_t> choice_counts() const {
    std::vector<std::int64_t> counts;
    for (const std::int32_t i : dependencies_.parameters) counts.push_back(grid_[at(i)].count);
    for (const std::int32_t i : dependencies_.inputs) counts.push_back(inputs_[at(i)].count());
    return counts;
  }

  bool fill(const std::vector<std::int64_t>& choice) {
    std::vector<Rational> slots(spec_.slot_count());
    std::int64_t base = 0;
    std::size_t position = 0;
    for (const std::int32_t i : dependencies_.parameters) {
      const std::int64_t k = choice[position++];
      slots[spec_.state_slot(at(i))] = grid_[at(i)].point(k);
      base += k * table_.state_stride[at(i)];
    }
    for (const std::int32_t i : dependencies_.inputs) {
      const std::int64_t k = choice[position++];
      slots[spec_.input_slot(at(i))] = inputs_[at(i)].values[static_cast<std::size_t>(k)];
      base += k * table_.input_stride[at(i)];
    }
    const SampledRow row = dynamics_.row(state_, slots);
    if (grid_[state_].discrete) {
      fill_points(row, slots, base);
    } else {
      fill_cells(row, base);
    }
    return row.exact;
  }

  /// Lower and upper end of the post, less `shift`, in units of the grid step, as forms of the cells'
  /// indices.
  [[nodiscard]] IndexForm end_form(const SampledRow& row, bool upper, const Rational& shift) const {
    const GridDimension& target = grid_[state_];
    std::vector<Rational> factors;
    std::vector<std::int64_t> counts;
    Rational offset = (upper ? row.upper : row.lower) - target.first;
    for (std::size_t j = 0; j < dependencies_.moving.size(); ++j) {
      const GridDimension& source = grid_[at(dependencies_.moving[j])];
      const Rational& m = row.coefficient[j];
      const Rational spread = abs(m) * source.radius();
      offset += m * source.first + (upper ? spread : Rational(-spread));
      factors.push_back(m * source.step / target.step);
      counts.push_back(source.count);
    }
    return IndexForm(factors, offset / target.step + shift, counts);
  }

  [[nodiscard]] bool upper_end_attained(const SampledRow& row) const {
    if (!row.exact) return true;  // the sound reading of an end that is only a bound
    for (std::size_t j = 0; j < row.coefficient.size(); ++j) {
      if (row.coefficient[j] > 0 && !grid_[at(dependencies_.moving[j])].discrete) return false;
    }
    return true;
  }

  template <class Entry>
  void for_each_cell(std::int64_t base, const Entry& entry) {
    std::vector<std::int64_t> counts;
    for (const std::int32_t j : dependencies_.moving) counts.push_back(grid_[at(j)].count);
    Counter cell(counts);
    do {
      std::int64_t position = base;
      for (std::size_t j = 0; j < counts.size(); ++j) {
        position += cell.indices()[j] * table_.state_stride[at(dependencies_.moving[j])];
      }
      table_.entries[static_cast<std::size_t>(position)] = entry(cell.indices());
    } while (cell.next());
  }

  /// Cell k is [k - 1/2, k + 1/2] in units of the step, without its upper end if half-open.
  void fill_cells(const SampledRow& row, std::int64_t base) {
    const Rational half(1, 2);
    const bool closed = spec_.abstraction.cells == Cells::closed;
    const bool attained = closed || upper_end_attained(row);
    const IndexForm lower = end_form(row, false, closed ? Rational(-half) : half);
    const IndexForm upper = end_form(row, true, half);
    for_each_cell(base, [&](const std::vector<std::int64_t>& cell) {
      const std::int64_t first = closed ? lower.ceil(cell) : lower.floor(cell);
      const std::int64_t last = attained ? upper.floor(cell) : upper.ceil(cell) - 1;
      return IndexRange{saturate_index(first), saturate_index(last)};
    });
  }

  void fill_points(const SampledRow& row, const std::vector<Rational>& slots, std::int64_t base) {
    bool spread = row.lower != row.upper;
    for (std::size_t j = 0; j < row.coefficient.size(); ++j) {
      if (row.coefficient[j] != 0 && !grid_[at(dependencies_.moving[j])].discrete) spread = true;
    }
    const IndexForm form = end_form(row, false, 0);
    for_each_cell(base, [&](const std::vector<std::int64_t>& cell) {
      if (spread || !form.integral(cell)) throw off_grid(row, slots, cell, spread);
      const std::int32_t index = saturate_index(form.floor(cell));
      return IndexRange{index, index};
    });
  }

  [[nodiscard]] SpecError off_grid(const SampledRow& row, const std::vector<Rational>& slots,
                                   const std::vector<std::int64_t>& cell, bool spread) const {
    std::string place;
    const auto append = [&](const std::string& name, const Rational& value) {
      place += fmt::format("{}{} = {}", place.empty() ? "" : ", ", name, to_text(value));
    };
    Rational value = row.lower;
    for (std::size_t j = 0; j < cell.size(); ++j) {
      const GridDimension& source = grid_[at(dependencies_.moving[j])];
      append(source.name, source.point(cell[j]));
      value += row.coefficient[j] * source.point(cell[j]);
    }
    for (const std::int32_t i : dependencies_.parameters)
      append(grid_[at(i)].name, slots[spec_.state_slot(at(i))]);
    for (const std::int32_t i : dependencies_.inputs)
      append(inputs_[at(i)].name, slots[spec_.input_slot(at(i))]);
    const GridDimension& target = grid_[state_];
    return SpecError(
        fmt::format(
            "the next value of the discrete state '{}' {}{}{}, expected {} + k * {} with an integer k",
            target.name, spread ? "can be a whole interval" : "is " + to_text(value),
            place.empty() ? "" : " at ", place, to_text(target.first), to_text(target.step)),
        "/dynamics/equations/" + target.name);
  }

  const ProblemSpec& spec_;
  const AffineDynamics& dynamics_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const Dependencies& dependencies_;
  TransitionTable& table_;
  std::size_t state_;
};

}  // namespace

std::vector<TableShape> table_shapes(const ProblemSpec& spec) {
  const AffineDynamics dynamics(spec);
  std::vector<TableShape> shapes;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const Dependencies& dependencies = dynamics.dependencies(i);
    TableShape shape{.states = dependencies.moving,
                     .inputs = dependencies.inputs,
                     .disturbances = dependencies.disturbances};
    shape.states.insert(shape.states.end(), dependencies.parameters.begin(), dependencies.parameters.end());
    std::sort(shape.states.begin(), shape.states.end());
    for (const std::int32_t j : shape.states) {
      shape.entries *= static_cast<double>(spec.states[static_cast<std::size_t>(j)].grid.count);
    }
    for (const std::int32_t j : shape.inputs) {
      shape.entries *= static_cast<double>(spec.inputs[static_cast<std::size_t>(j)].values.size());
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

bool check_dynamics(const ProblemSpec& spec) {
  const AffineDynamics dynamics(spec);
  bool exact = true;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const Dependencies& dependencies = dynamics.dependencies(i);
    std::vector<std::int64_t> counts;
    for (const std::int32_t j : dependencies.parameters) counts.push_back(spec.states[at(j)].grid.count);
    for (const std::int32_t j : dependencies.inputs) {
      counts.push_back(static_cast<std::int64_t>(spec.inputs[at(j)].values.size()));
    }
    Counter choice(counts);
    do {
      std::vector<Rational> slots(spec.slot_count());
      std::size_t position = 0;
      for (const std::int32_t j : dependencies.parameters) {
        const GridSpec& grid = spec.states[at(j)].grid;
        slots[spec.state_slot(at(j))] =
            grid.first + grid.step * Rational(static_cast<long>(choice.indices()[position++]));
      }
      for (const std::int32_t j : dependencies.inputs) {
        slots[spec.input_slot(at(j))] =
            spec.inputs[at(j)].values[static_cast<std::size_t>(choice.indices()[position++])];
      }
      exact = dynamics.row(i, slots).exact && exact;
    } while (choice.next());
  }
  return exact;
}

Abstraction build_abstraction(const ProblemSpec& spec, ThreadTeam& team) {
  const AffineDynamics dynamics(spec);
  Abstraction abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec)};
  abstraction.tables.resize(spec.states.size());
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const bool exact = TableBuilder(spec, dynamics, abstraction, i).build(team);
    abstraction.exact = abstraction.exact && exact;
  }
  return abstraction;
}

}  // namespace coordreq
