#include "safety/action_groups.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Numbers distinct keys 0, 1, ... in the order of their first appearance.
template <class Key>
class Numbering {
 public:
  std::uint32_t operator()(Key key) {
    return numbers_.try_emplace(std::move(key), static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

 private:
  std::map<Key, std::uint32_t> numbers_;
};

/// The offset in a table of every joint action of some inputs, row-major over `inputs`.
std::vector<std::int64_t> offsets(const InputSpace& space, const std::vector<std::int32_t>& inputs,
                                  const std::vector<std::int64_t>& stride) {
  std::vector<std::int64_t> result = {0};
  for (const std::int32_t i : inputs) {
    std::vector<std::int64_t> next;
    for (const std::int64_t offset : result) {
      for (std::int64_t k = 0; k < space[at(i)].count(); ++k) next.push_back(offset + k * stride[at(i)]);
    }
    result = std::move(next);
  }
  return result;
}

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

ActionGrouping::ActionGrouping(const RowEngine& engine, std::vector<InputClass> classes) : engine_(&engine) {
  add_sources();
  for (InputClass& inputs : classes) {
    std::sort(inputs.begin(), inputs.end());
    classes_.push_back(make_class(std::move(inputs)));
  }
}

void ActionGrouping::add_sources() {
  for (const RowSlices& slices : engine_->slices()) {
    Source source;
    source.shared_ids = &slices.ids;
    source.state_stride = slices.state_stride;
    source.input_stride = slices.input_stride;
    source.inputs = slices.inputs;
    source.input_combinations = slices.input_combinations;
    sources_.push_back(std::move(source));
  }
  const ConditionTable* allow = engine_->allow();
  if (allow == nullptr) return;
  Source source{.state_stride = allow->state_stride(),
                .input_stride = allow->input_stride(),
                .inputs = allow->inputs()};
  for (const std::int32_t i : source.inputs)
    source.input_combinations *= engine_->abstraction().inputs[at(i)].count();
  Numbering<std::vector<Word>> numbering;
  for (std::int64_t r = 0; r < allow->bits().rows(); ++r) {
    const auto bits = allow->bits().row(r);
    source.ids.push_back(numbering(std::vector<Word>(bits.begin(), bits.end())));
  }
  sources_.push_back(std::move(source));
}

ActionGrouping::ClassData ActionGrouping::make_class(InputClass inputs) const {
  const InputSpace& space = engine_->abstraction().inputs;
  ClassData data{.inputs = std::move(inputs)};
  for (const std::int32_t i : data.inputs) data.actions *= space[at(i)].count();
  for (std::size_t t = 0; t < sources_.size(); ++t) {
    data.contribution.push_back(offsets(space, data.inputs, sources_[t].input_stride));
    if (!intersection(sources_[t].inputs, data.inputs).empty()) data.views.push_back(make_view(t, data));
  }
  return data;
}

ActionGrouping::View ActionGrouping::make_view(std::size_t table, const ClassData& data) const {
  const InputSpace& space = engine_->abstraction().inputs;
  const Source& source = sources_[table];
  const std::vector<std::int32_t> own = intersection(source.inputs, data.inputs);
  const std::vector<std::int32_t> others = difference(source.inputs, data.inputs);
  View view{.table = table};
  for (const std::int32_t i : own) view.width *= space[at(i)].count();

  // Number of each action's combination of the inputs in use, row-major over `own`.
  std::vector<std::int64_t> own_stride(space.size(), 0);
  std::int64_t stride = 1;
  for (auto it = own.rbegin(); it != own.rend(); ++it) {
    own_stride[at(*it)] = stride;
    stride *= space[at(*it)].count();
  }
  for (const std::int64_t c : offsets(space, data.inputs, own_stride)) {
    view.combination.push_back(static_cast<std::int32_t>(c));
  }
  if (others.empty()) return view;

  const std::vector<std::int64_t> own_offsets = offsets(space, own, source.input_stride);
  const std::vector<std::int64_t> other_offsets = offsets(space, others, source.input_stride);
  const auto total = static_cast<std::int64_t>(source.all().size());
  Numbering<std::vector<std::uint32_t>> numbering;
  for (std::int64_t base = 0; base < total; base += source.input_combinations) {
    for (const std::int64_t offset : own_offsets) {
      std::vector<std::uint32_t> column;
      for (const std::int64_t other : other_offsets) {
        column.push_back(source.all()[static_cast<std::size_t>(base + offset + other)]);
      }
      view.partial.push_back(numbering(std::move(column)));
    }
  }
  return view;
}

std::int64_t ActionGrouping::source_base(std::int64_t row, std::size_t table) const {
  const UniformGrid& grid = engine_->abstraction().grid;
  std::int64_t base = 0;
  for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
    const std::int64_t stride = sources_[table].state_stride[i];
    if (stride != 0) base += grid.index(row * grid.row_length(), i) * stride;
  }
  return base;
}

void ActionGrouping::group(std::int64_t row, RowGroups& groups) const {
  groups.classes.resize(classes_.size());
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    const ClassData& data = classes_[c];
    RowGroups::Class& result = groups.classes[c];
    result.group_of.assign(static_cast<std::size_t>(data.actions), 0);
    for (const View& view : data.views) {
      const Source& source = sources_[view.table];
      const std::int64_t base = source_base(row, view.table);
      const std::uint32_t* ids = view.partial.empty()
                                     ? source.all().data() + base
                                     : view.partial.data() + base / source.input_combinations * view.width;
      numbers.clear();
      for (std::size_t a = 0; a < result.group_of.size(); ++a) {
        const std::uint64_t key = std::uint64_t{result.group_of[a]} << 32 | ids[view.combination[a]];
        result.group_of[a] =
            numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
      }
    }
    result.representative.clear();
    for (std::size_t a = 0; a < result.group_of.size(); ++a) {
      if (result.group_of[a] == result.representative.size()) {
        result.representative.push_back(static_cast<std::uint32_t>(a));
      }
    }
  }
}

ActionGrouping::Tuples::Tuples(const ActionGrouping& grouping, std::int64_t row, const RowGroups& groups)
    : grouping_(grouping), groups_(groups), chosen_(grouping.size(), 0), ids_(grouping.engine_->tables()) {
  for (std::size_t t = 0; t < grouping.sources_.size(); ++t) bases_.push_back(grouping.source_base(row, t));
}

std::int64_t ActionGrouping::Tuples::contribution(std::size_t c, std::size_t table) const {
  return grouping_.classes_[c].contribution[table][groups_.classes[c].representative[chosen_[c]]];
}

std::span<const std::uint32_t> ActionGrouping::Tuples::slice_ids() {
  for (std::size_t t = 0; t < ids_.size(); ++t) {
    std::int64_t position = bases_[t];
    for (std::size_t c = 0; c < chosen_.size(); ++c) position += contribution(c, t);
    ids_[t] = grouping_.sources_[t].all()[static_cast<std::size_t>(position)];
  }
  return ids_;
}

ConstRow ActionGrouping::Tuples::allowed() const {
  const ConditionTable* allow = grouping_.engine_->allow();
  if (allow == nullptr) return {};
  const std::size_t t = ids_.size();
  std::int64_t position = bases_[t];
  for (std::size_t c = 0; c < chosen_.size(); ++c) position += contribution(c, t);
  return allow->bits().row(position);
}

bool ActionGrouping::Tuples::next() {
  for (std::size_t c = chosen_.size(); c-- > 0;) {
    if (++chosen_[c] < groups_.classes[c].representative.size()) return true;
    chosen_[c] = 0;
  }
  return false;
}

std::int64_t ActionGrouping::Tuples::count() const {
  std::int64_t product = 1;
  for (const RowGroups::Class& c : groups_.classes)
    product *= static_cast<std::int64_t>(c.representative.size());
  return product;
}

}  // namespace coordreq
