#include "reach/enclosure_sample.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/index.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

bool is_enclosed(const SystemSpec& spec, const AffineDynamics& dynamics, std::size_t state) {
  if (spec.dynamics.update(state) != nullptr) return false;
  const Dependencies& dependencies = dynamics.dependencies(state);
  for (const int half : {0, 1, 2}) {
    std::vector<Rational> slots(spec.slot_count());
    for (const std::int32_t j : dependencies.parameters) {
      const GridSpec& grid = spec.states[at(j)].grid;
      slots[spec.state_slot(at(j))] = grid.point((grid.count - 1) * half / 2);
    }
    for (const std::int32_t j : dependencies.inputs) {
      const std::vector<Rational>& values = spec.inputs[at(j)].values;
      slots[spec.input_slot(at(j))] = values[(values.size() - 1) * static_cast<std::size_t>(half) / 2];
    }
    if (!dynamics.row(state, slots)) return true;
  }
  return false;
}

/// The root of x^(n+1) = x + 1: multiples of its inverse powers fill a cube of n dimensions evenly, as those
/// of the golden ratio do an interval.
double evenly(std::size_t dimensions) {
  double root = 2.0;
  for (int k = 0; k < 60; ++k) root = std::pow(1.0 + root, 1.0 / (static_cast<double>(dimensions) + 1.0));
  return root;
}

}  // namespace

std::vector<EnclosedGroup> enclosed_groups(const SystemSpec& spec, const std::vector<TableShape>& shapes) {
  const AffineDynamics dynamics(spec);
  std::vector<EnclosedGroup> groups;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!is_enclosed(spec, dynamics, i)) continue;
    const auto serves = [&](const EnclosedGroup& group) {
      const Dependencies& shape = shapes[group.states.front()];
      return spec.dynamics.time == Time::continuous && shape == shapes[i] && group.terms == shapes[i].terms;
    };
    const auto group = std::find_if(groups.begin(), groups.end(), serves);
    if (group == groups.end()) {
      groups.push_back({{i}, shapes[i].terms});
    } else {
      group->states.push_back(i);
    }
  }
  return groups;
}

EnclosureSample::EnclosureSample(const SystemSpec& spec, const EnclosedGroup& group)
    : enclosure_(spec, find_dependencies(spec, group.states.front()), group.states, !group.terms.empty()) {
  const Dependencies dependencies = find_dependencies(spec, group.states.front());
  for (const std::int32_t j : dependencies.all_states()) {
    if (enclosure_.shifts() && at(j) == group.states.front()) continue;
    if (contains(group.terms, j)) {
      enclosure_.set(spec.state_slot(at(j)), {0.0, 0.0});
      continue;
    }
    const GridDimension dimension = dimension_of(spec.states[at(j)]);
    choices_.add_state(dimension, spec.state_slot(at(j)), dimension.count);
    counts_.push_back(dimension.count);
  }
  const InputSpace inputs = make_input_space(spec);
  for (const std::int32_t j : dependencies.inputs) {
    choices_.add_input(inputs[at(j)], spec.input_slot(at(j)));
    counts_.push_back(inputs[at(j)].count());
  }
  const double root = evenly(counts_.size());
  double stride = 1.0;
  for (std::size_t v = 0; v < counts_.size(); ++v) strides_.push_back(stride /= root);
}

double EnclosureSample::choices() const {
  return std::accumulate(counts_.begin(), counts_.end(), 1.0, [](double product, std::int64_t count) {
    return product * static_cast<double>(count);
  });
}

std::int64_t EnclosureSample::enclose_next() {
  std::vector<std::int64_t> choice;
  for (std::size_t v = 0; v < counts_.size(); ++v) {
    const double share = std::fmod(0.5 + static_cast<double>(drawn_) * strides_[v], 1.0);
    const auto index = static_cast<std::int64_t>(share * static_cast<double>(counts_[v]));
    choice.push_back(std::min(index, counts_[v] - 1));
  }
  ++drawn_;
  const std::int64_t before = enclosure_.enclosed();
  choices_.for_each_piece(choice, enclosure_, [this](const auto&) { enclosure_.enclose(); });
  return enclosure_.enclosed() - before;
}

}  // namespace coordreq
