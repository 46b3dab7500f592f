#include "engine/action_groups.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <unordered_map>

#include "base/fast_paths.hpp"
#include "base/requires.hpp"
#include "engine/limits.hpp"
#include "engine/list_numbers.hpp"

namespace coordreq {
namespace {

std::vector<std::int32_t> intersection(const std::vector<std::int32_t>& a,
                                       const std::vector<std::int32_t>& b) {
  std::vector<std::int32_t> result;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

std::vector<std::int32_t> difference(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
  std::vector<std::int32_t> result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

ActionGrouping::ActionGrouping(const RowEngine& engine, const std::vector<InputClass>& classes,
                               std::vector<ActionSource> sources, ThreadTeam& team)
    : engine_(&engine), sources_(std::move(sources)) {
  REQUIRES(std::accumulate(classes.begin(), classes.end(), std::size_t{0},
                           [](std::size_t sum, const InputClass& one) {
                             return sum + one.inputs().size();
                           }) == engine.abstraction().inputs.size());
  for (const InputClass& inputs : classes) {
    classes_.push_back(make_class(inputs));
    share_groups(classes_.back(), team);
  }
}

ActionGrouping::ClassData ActionGrouping::make_class(const InputClass& inputs) const {
  ClassData data{.inputs = inputs};
  for (std::size_t t = 0; t < sources_.size(); ++t) {
    data.contribution.push_back(inputs.offsets(sources_[t].input_stride));
    if (!intersection(sources_[t].inputs, inputs.inputs()).empty()) data.views.push_back(make_view(t, data));
  }
  return data;
}

ActionGrouping::View ActionGrouping::make_view(std::size_t table, const ClassData& data) const {
  const InputSpace& space = engine_->abstraction().inputs;
  const ActionSource& source = sources_[table];
  const InputClass used(space, intersection(source.inputs, data.inputs.inputs()));
  const InputClass others(space, difference(source.inputs, data.inputs.inputs()));
  View view{.table = table, .width = used.actions()};

  view.all_distinct = source.all_distinct();
  if (others.inputs().empty()) {
    // The table's layout is row-major over `used` too.
    for (const std::int64_t c : data.inputs.offsets(source.input_stride)) {
      view.combination.push_back(static_cast<std::int32_t>(c));
    }
    return view;
  }
  // Number of each action's combination of the inputs in use.
  for (const std::int64_t c : data.inputs.offsets(used.strides())) {
    view.combination.push_back(static_cast<std::int32_t>(c));
  }
  if (view.all_distinct) return view;
  const std::vector<std::int64_t> used_offsets = used.offsets(source.input_stride);
  const std::vector<std::int64_t> other_offsets = others.offsets(source.input_stride);
  const auto total = static_cast<std::int64_t>(source.ids->size());
  ListNumbers<std::uint32_t> numbers;
  std::vector<std::uint32_t> column;
  for (std::int64_t base = 0; base < total; base += source.input_combinations) {
    for (const std::int64_t offset : used_offsets) {
      column.clear();
      for (const std::int64_t other : other_offsets)
        column.push_back((*source.ids)[static_cast<std::size_t>(base + offset + other)]);
      view.partial.push_back(numbers.number(column));
    }
  }
  return view;
}

const std::uint32_t* ActionGrouping::view_ids(const View& view, const RowPosition& position) const {
  if (view.all_distinct) return nullptr;
  const ActionSource& source = sources_[view.table];
  const std::int64_t base = source.base(position);
  if (view.partial.empty()) return source.ids->data() + base;
  return view.partial.data() + base / source.input_combinations * view.width;
}

ActionGroups ActionGrouping::find_groups(const ClassData& data, const RowPosition& position) const {
  ActionGroups groups;
  groups.group_of.assign(static_cast<std::size_t>(data.inputs.actions()), 0);
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  if (!fast_paths().grouped_actions) std::iota(groups.group_of.begin(), groups.group_of.end(), 0U);
  for (const View& view : data.views) {
    const std::uint32_t* ids = view_ids(view, position);
    numbers.clear();
    for (std::size_t a = 0; a < groups.group_of.size(); ++a) {
      const auto combination = static_cast<std::uint32_t>(view.combination[a]);
      const std::uint32_t id = ids == nullptr ? combination : ids[combination];
      const std::uint64_t key = std::uint64_t{groups.group_of[a]} << 32 | id;
      groups.group_of[a] = numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
  }
  for (std::size_t a = 0; a < groups.group_of.size(); ++a) {
    if (groups.group_of[a] == groups.size()) groups.representative.push_back(static_cast<std::uint32_t>(a));
  }
  compare_groups(data, position, groups);
  return groups;
}

void ActionGrouping::compare_groups(const ClassData& data, const RowPosition& position,
                                    ActionGroups& groups) const {
  const std::size_t size = groups.size();
  groups.all.resize(size);
  std::iota(groups.all.begin(), groups.all.end(), 0U);
  groups.holders.resize(size);
  if (!fast_paths().covered_actions || std::ssize(groups.representative) > kMostComparedGroups) {
    groups.minimal = groups.maximal = groups.all;
    return;
  }
  groups.within.assign(size * size, 1);
  for (const View& view : data.views) {
    const std::uint32_t* ids = view_ids(view, position);
    // Numbers of columns, or of rows of `allow`, do not tell which is inside which.
    const RowSlices* slices = view.partial.empty() ? sources_[view.table].slices : nullptr;
    const GridDimension& target = engine_->target(slices == nullptr ? 0 : view.table);
    const auto number = [&](std::size_t g) {
      const std::int32_t combination = view.combination[groups.representative[g]];
      return ids == nullptr ? static_cast<std::uint32_t>(combination) : ids[combination];
    };
    for (std::size_t g = 0; g < size; ++g) {
      for (std::size_t h = 0; h < size; ++h) {
        std::uint8_t& within = groups.within[g * size + h];
        if (within == 0) continue;
        const std::uint32_t a = number(g);
        const std::uint32_t b = number(h);
        within = a == b || (slices != nullptr && slices->is_within(a, b, target)) ? 1 : 0;
      }
    }
  }
  for (std::uint32_t g = 0; g < size; ++g) {
    bool minimal = true;
    bool maximal = true;
    for (std::uint32_t h = 0; h < size; ++h) {
      if (h == g) continue;
      if (groups.is_within(g, h)) groups.holders[g].push_back(h);
      // The lower one of two groups that are within each other stays.
      const bool contains = groups.is_within(h, g);
      const bool contained = groups.is_within(g, h);
      minimal = minimal && (!contains || (contained && g < h));
      maximal = maximal && (!contained || (contains && g < h));
    }
    if (minimal) groups.minimal.push_back(g);
    if (maximal) groups.maximal.push_back(g);
  }
}

/// The choices of states in local rows, from the first to the last.
RowShare::Range ActionGrouping::held_choices(const ClassData& data, std::int64_t choices) const {
  const RowShare* const share = engine_->share();
  const RowShare::Range local = local_rows(share, engine_->rows());
  if (local.begin == local.end) return {0, 0};
  const std::int64_t of_leading = data.state_stride.front();
  if (share == nullptr || of_leading == 0) return {0, choices};
  if (choices == engine_->rows()) return local;
  const std::int64_t rows = engine_->grid().row_stride(0);
  return {local.begin / rows * of_leading, ((local.end - 1) / rows + 1) * of_leading};
}

void ActionGrouping::share_groups(ClassData& data, ThreadTeam& team) const {
  const UniformGrid& grid = engine_->abstraction().grid;
  data.state_stride.assign(grid.size(), 0);
  std::int64_t choices = 1;
  for (std::size_t i = grid.size() - 1; i-- > 0;) {
    const bool used = std::any_of(data.views.begin(), data.views.end(), [&](const View& view) {
      return !view.all_distinct && sources_[view.table].state_stride[i] != 0;
    });
    if (!used) continue;
    data.state_stride[i] = choices;
    choices *= grid[i].count;
  }
  if (!fast_paths().shared_groups || choices > most_shared_choices(data.inputs.actions())) return;
  const RowShare::Range held = held_choices(data, choices);
  data.before = held.begin;
  const auto find = [&](std::int64_t choice) {
    std::int64_t row = 0;  // any row with these states
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
      if (data.state_stride[i] == 0) continue;
      row += choice / data.state_stride[i] % grid[i].count * (grid.stride(i) / grid.row_length());
    }
    return find_groups(data, RowPosition(grid, row));
  };
  SharedListNumbers lists;
  data.shared.resize(static_cast<std::size_t>(held.end - held.begin));
  team.for_each(std::ssize(data.shared), 16, [&](ThreadTeam::Range range, int) {
    std::vector<std::uint32_t> list;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      ActionGroups groups = find(held.begin + i);
      list = groups.group_of;
      list.resize(list.size() + (groups.within.size() + 3) / 4, 0);
      std::ranges::copy(groups.within, reinterpret_cast<std::uint8_t*>(list.data() + groups.group_of.size()));
      data.shared[static_cast<std::size_t>(i)] =
          lists.number(list, [&](std::size_t shard, std::uint32_t number) {
            if (number == data.distinct[shard].size()) data.distinct[shard].push_back(std::move(groups));
          });
    }
  });
}

void ActionGrouping::group(const RowPosition& position, RowGroups& groups) const {
  groups.classes.resize(classes_.size());
  groups.unshared.resize(classes_.size());
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    const ClassData& data = classes_[c];
    if (data.shared.empty()) {
      groups.unshared[c] = find_groups(data, position);
      groups.classes[c] = &groups.unshared[c];
      continue;
    }
    const std::int64_t choice = position.offset(data.state_stride) - data.before;
    const std::uint32_t number = data.shared[static_cast<std::size_t>(choice)];
    groups.classes[c] =
        &data.distinct[SharedListNumbers::shard_of(number)][SharedListNumbers::in_shard(number)];
  }
}

}  // namespace coordreq
