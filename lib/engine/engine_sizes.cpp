#include "engine/engine_sizes.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "engine/action_groups.hpp"
#include "engine/join_rows.hpp"
#include "engine/level_kernels.hpp"
#include "engine/limits.hpp"
#include "reach/usual_slices.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

double in_double(std::int64_t number) {
  return static_cast<double>(number);
}

double row_of_words(std::int64_t cells) {
  return sizeof(CellSet::Word) * in_double((cells + CellSet::kWordBits - 1) / CellSet::kWordBits);
}

/// Bytes of an ActionGroups, with the memory that finds equal ones.
double one_grouping(double actions, double groups) {
  constexpr double kBytesOfAction = 8, kBytesOfGroup = 40, kBytesOfPair = 2.5;
  const double pairs = groups <= kMostComparedGroups ? groups * groups : 0;
  return sizeof(ActionGroups) + actions * kBytesOfAction + groups * kBytesOfGroup + pairs * kBytesOfPair;
}

bool has_common(const std::vector<std::int32_t>& list, const InputClass& inputs) {
  return std::ranges::any_of(list, [&](std::int32_t j) { return inputs.contains(j); });
}

}  // namespace

std::vector<double> bytes_of_slices(const RowEngine& engine) {
  constexpr double kBytesBesideSlice = 64;  // its entry in the hash set, and the overhead of the allocator
  std::vector<double> result;
  for (const RowSlices& slices : engine.posts().slices)
    result.push_back(static_cast<double>(slices.bytes()) +
                     kBytesBesideSlice * static_cast<double>(slices.slices.size()));
  return result;
}

EngineSizes::EngineSizes(const Model& model, RowFractions fractions)
    : model_(&model),
      fractions_(std::move(fractions)),
      offsets_(usual_offsets(model.spec())),
      widths_(usual_widths(model.spec())),
      grid_(join_rows(model, offsets_)) {
  fractions_.held = std::max(fractions_.held, 1 / in_double(grid_.rows()));
  fractions_.local = std::max(fractions_.local, 1 / in_double(grid_.rows()));
  for (std::size_t i = grid_.across(); i < grid_.size(); ++i) {
    const GridDimension& dimension = grid_[i];
    const RowMargins margins = window_margins({&offsets_[grid_.state(i)], 1}, dimension);
    shape_.dimensions.push_back(
        {dimension.count, grid_.stride(i), margins, {dimension.below, dimension.above}});
  }
  fractions_.slices.reserve(grid_.size());
  for (std::size_t t = fractions_.slices.size(); t < grid_.size(); ++t)
    fractions_.slices.push_back(usual_bytes(t));
}

double EngineSizes::set() const {
  return rows() * row_of_words(grid_.row_length());
}

double EngineSizes::levels() const {
  constexpr std::int64_t kAlign = 16;
  const RowMargins margins = shape_.margins();
  const std::int64_t row = margins.before + shape_.length() + margins.after;
  return (rows() + 1) * in_double((row + kAlign - 1) / kAlign * kAlign) + kLevelBlock;
}

double EngineSizes::usual_bytes(std::size_t t) const {
  constexpr double kBytesOfSlice = 240;  // its list, and its entry in the hash set of slices
  const TableShape& shape = model_->arranged_shapes()[t];
  if (model_->keeps_sums() && shape.sum) return shape.bytes;  // the same numbers laid out for reading
  double choices = 1;
  bool is_cut = false;
  for (const std::int32_t j : shape.states) {
    const auto i = at(j);
    const bool is_along = i >= grid_.across();
    if (!is_along) choices *= in_double(grid_[i].count);
    is_cut = is_cut || (is_along && !(i == t && shape.shift && !shape.sum));
  }
  for (const std::int32_t j : shape.inputs) choices *= in_double(model_->inputs()[at(j)].count());
  double bytes = choices * sizeof(std::uint32_t);
  if (is_cut) {
    const std::size_t state = grid_.state(t);
    const UsualSlices usual =
        usual_slices(model_->spec(), state, model_->shapes()[state], grid_.state(grid_.size() - 1));
    bytes += std::min(usual.different, choices) * (usual.segments * sizeof(RowSegment) + kBytesOfSlice);
  }
  return fraction_of_table(t) * bytes;
}

double EngineSizes::fraction_of_table(std::size_t t) const {
  return model_->arranged_shapes()[t].is_by_cells(grid_.size()) ? fractions_.local : 1;
}

double EngineSizes::unsent_entries() const {
  if (fractions_.local == 1) return 0;
  // A flow encloses several states at once, a map one.
  const bool are_together = model_->spec().dynamics.time == Time::continuous;
  double bytes = 0;
  for (const TableShape& shape : model_->shapes()) {
    if (shape.sum) continue;
    bytes = are_together ? bytes + shape.bytes : std::max(bytes, shape.bytes);
  }
  return fractions_.local * bytes;
}

double EngineSizes::hull() const {
  constexpr double kBytesOfRow = 80;
  return in_double(grid_.rows()) * kBytesOfRow;
}

double EngineSizes::condition(const Program& condition) const {
  const UniformGrid& grid = model_->grid();
  double choices = 1;
  for (std::uint32_t slot : condition.variables()) {
    const std::size_t points = grid.size() + model_->inputs().size();
    if (slot >= points) slot -= static_cast<std::uint32_t>(points);  // a cell: ControllerSpec::allow
    if (slot < grid.size() && slot != grid.state(grid.size() - 1))
      choices *= in_double(grid[grid.dimension_of(slot)].count);
    if (slot >= grid.size()) choices *= in_double(model_->inputs()[slot - grid.size()].count());
  }
  return choices * row_of_words(grid.row_length());
}

double EngineSizes::condition_of_held(const Program& condition) const {
  const UniformGrid& grid = model_->grid();
  const std::vector<std::uint32_t> slots = condition.variables();
  const bool is_cut = grid.size() > 1 && std::ranges::find(slots, grid.state(0)) != slots.end();
  return this->condition(condition) * (is_cut ? std::max(fractions_.held, 1 / in_double(grid[0].count)) : 1);
}

double EngineSizes::packed_pairs(std::int64_t actions) const {
  return fractions_.held * cells() * in_double(PackedPairs::bytes_for(actions));
}

double EngineSizes::pair_table() const {
  const UniformGrid& grid = model_->grid();
  return in_double(grid.rows()) * in_double(model_->inputs().count()) *
         (row_of_words(grid.row_length()) + sizeof(std::uint32_t));
}

double EngineSizes::groups(const std::vector<InputClass>& classes) const {
  double sum = 0;
  for (const InputClass& inputs : classes) sum += groups_of_class(inputs);
  return sum;
}

/// How far posts go in dimension i, in indices, either way.
RowMargins EngineSizes::reach_of(std::size_t i) const {
  const IndexRange offsets = offsets_[grid_.state(i)];
  return {std::max<std::int64_t>(0, -std::int64_t{offsets.first}), std::max<std::int64_t>(0, offsets.last)};
}

/// Bytes of the groups of a class: one ActionGroups for each different choice of the states that it depends
/// on, or none where they are found anew for each row.
double EngineSizes::groups_of_class(const InputClass& inputs) const {
  enum Use : std::uint8_t { none, by_offset, in_full };
  const ControllerSpec& controller = model_->spec().controller;
  const double actions = in_double(inputs.actions());
  std::vector<Use> use(grid_.size(), controller.allow || controller.file ? in_full : none);
  double groups = 1;
  for (std::size_t t = 0; t < grid_.size(); ++t) {
    const TableShape& shape = model_->arranged_shapes()[t];
    if (!has_common(shape.inputs, inputs)) continue;
    groups *= shape.shift ? in_double(reach_of(t).before + reach_of(t).after + 1) : actions;
    for (const std::int32_t j : shape.states) {
      Use& state_use = use[at(j)];
      state_use = std::max(state_use, shape.shift ? by_offset : in_full);
    }
  }
  double choices = 1, distinct = 1;
  for (std::size_t i = 0; i < grid_.across(); ++i) {
    if (use[i] == none) continue;
    const double count = in_double(grid_[i].count);
    choices *= count;
    // Near the ends of the domain, where posts leave, groups differ from those inside.
    const double near_ends = in_double(reach_of(i).before + reach_of(i).after + 1);
    distinct *= use[i] == by_offset ? std::min(count, near_ends) : count;
  }
  const double offsets = actions * in_double(std::ssize(grid_.dimensions())) * (sizeof(std::int64_t) + 4);
  if (choices > in_double(most_shared_choices(inputs.actions()))) return offsets;
  // A process finds those of its local rows, or of their first indices (ActionGrouping::held_choices).
  if (grid_.across() > 0 && use[0] != none) {
    const double held = choices < in_double(grid_.rows())
                            ? std::max(fractions_.local, 1 / in_double(grid_[0].count))
                            : fractions_.local;
    choices *= held;
    distinct = use[0] == in_full ? distinct * held : std::min(distinct, choices);
  }
  return offsets + choices * sizeof(std::uint32_t) +
         distinct * one_grouping(actions, std::min(groups, actions));
}

double EngineSizes::readers(int threads, double level_bytes) const {
  constexpr double kRows = 8;  // in the buffers of a reader and its operator
  const double all = level_bytes * levels();
  const double one = kRows * all / rows();
  if (!model_->keeps_sums()) {
    const double unit = all / in_double(grid_[0].count);
    return threads * (one + std::min(all, std::max(2 * unit, in_double(kSharedBytes))));
  }
  double cells_of_unit = 1;
  for (std::size_t i = 0; i < grid_.size(); ++i)
    cells_of_unit *= model_->arranged_shapes()[i].sum ? in_double(grid_[i].count) : 1;
  const auto rows_of_unit =
      static_cast<std::int64_t>(std::max(1.0, cells_of_unit / in_double(grid_.row_length())));
  const double units = std::min<double>(threads, in_double(units_at_once(threads, rows_of_unit)));
  return threads * one + units * level_bytes * patches();
}

/// SumPatches of a unit, margins included, for the ranges of the leading dimensions that it goes to.
double EngineSizes::patches() const {
  constexpr double kUsualSizes = 2;  // of a box, in each dimension
  constexpr double kUsualJoined = 8;
  constexpr double kBytesOfMargin = 12;
  double patch = 1, inside = 1, sizes = 1, led = 1;
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const TableShape& shape = model_->arranged_shapes()[i];
    if (!shape.sum) {
      for (const std::int32_t j : shape.inputs) led *= in_double(model_->inputs()[at(j)].count());
      continue;
    }
    const double reach = widths_[grid_.state(i)] + most_wider(static_cast<std::int32_t>(grid_[i].count));
    inside *= in_double(grid_[i].count);
    patch *= in_double(grid_[i].count) + 2 * (reach + 1);
    sizes *= kUsualSizes;
  }
  const double fitting = std::max(2.0, static_cast<double>(kPatchBytes) / (sizes * patch));
  const double slots = std::min(led, fitting);
  return (slots * sizes + kUsualJoined) * patch + kBytesOfMargin * (patch - inside);
}

double EngineSizes::wave(int threads) const {
  // Rows of a batch before they are written, in vectors that grow; and the two orders of units.
  const double batch = std::max(levels() / in_double(grid_[0].count), in_double(2 * kMostLevelsOfBatch));
  return readers(threads) + std::min(levels(), batch) + 2 * sizeof(std::uint32_t) * rows();
}

}  // namespace coordreq
