#include "answers/checking/posts.hpp"

#include <algorithm>

namespace coordreq {
namespace {

bool same(const ResolvedRange& a, const ResolvedRange& b) {
  return a.blocked == b.blocked && a.inside == b.inside;
}

ResolvedRange once_round(IndexRange raw, std::int64_t count) {
  const std::int64_t length = std::int64_t{raw.last} - raw.first + 1;
  const bool lost = raw.first == INT32_MIN || raw.last == INT32_MAX;
  if (lost || length >= count) return {.inside = {0, static_cast<std::int32_t>(count - 1)}};
  const std::int64_t first = ((raw.first % count) + count) % count;
  return {.inside = {static_cast<std::int32_t>(first), static_cast<std::int32_t>(first + length - 1)}};
}

/// Whether states that leave there are in the absorbing cell T.
bool arrives(Outside rule) {
  return rule == Outside::safe || rule == Outside::goal;
}

}  // namespace

ResolvedRange after_leaving(IndexRange raw, const GridDimension& dimension) {
  if (dimension.periodic()) return once_round(raw, dimension.count);
  const auto top = static_cast<std::int32_t>(dimension.count - 1);
  ResolvedRange result{.inside = raw};
  if (raw.first < 0) {
    if (dimension.below == Outside::unsafe) result.blocked = true;
    result.inside.first = 0;
    if (!arrives(dimension.below) && raw.last < 0) result.inside.last = 0;
  }
  if (raw.last > top) {
    if (dimension.above == Outside::unsafe) result.blocked = true;
    result.inside.last = top;
    if (!arrives(dimension.above) && raw.first > top) result.inside.first = top;
  }
  return result;
}

Posts make_posts(const UniformGrid& grid, const InputSpace& inputs, const std::vector<PostTable>& tables) {
  Posts posts{.grid = &grid, .joint_inputs = inputs.count()};
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const PostTable& table = tables[i];
    posts.tables.push_back(&table);
    auto& resolved = posts.resolved.emplace_back();
    resolved.reserve(table.entries.size());
    for (const IndexRange& raw : table.entries) resolved.push_back(after_leaving(raw, grid[i]));
    auto& offsets = posts.input_offset.emplace_back();
    for (std::int64_t u = 0; u < inputs.count(); ++u) {
      std::int64_t offset = 0;
      for (const std::size_t j : table.inputs) offset += inputs.index(u, j) * table.input_stride[j];
      offsets.push_back(static_cast<std::int32_t>(offset));
    }
    std::int64_t choices = 1;
    for (const std::size_t j : table.inputs) choices *= inputs[j].count();
    posts.input_choices.push_back(choices);
  }
  return posts;
}

PostMinima::PostMinima(const Posts& posts)
    : posts_(&posts),
      grid_(posts.grid),
      input_offset_(&posts.input_offset),
      split_((posts.tables.size() + 1) / 2),
      different_(posts.tables.size()),
      ranks_(posts.tables.size()),
      window_(posts.tables.size()),
      box_(posts.tables.size()) {
  for (std::size_t i = 0; i < ranks_.size(); ++i)
    ranks_[i].resize(static_cast<std::size_t>(posts.input_choices[i]));
}

void PostMinima::go_to(std::int64_t cell) {
  boxes_ = 1;
  inner_boxes_ = 1;
  std::int64_t outer_cells = 1;
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    find_ranges(i, cell);
    const auto ranges = static_cast<std::int64_t>(different_[i].size());
    boxes_ = std::min(boxes_ * ranges, kMostMinima + 1);
    if (i >= split_) inner_boxes_ = std::min(inner_boxes_ * ranges, kMostMinima + 1);
    const std::int64_t width = std::int64_t{window_[i].last} - window_[i].first + 1;
    if (i < split_) outer_cells = std::min(outer_cells * width, kMostMinima + 1);
  }
  minima_ = outer_cells * inner_boxes_;
  // With few joint inputs and many minima, clearing the memory costs more than it saves.
  const std::int64_t most = std::min(kMostMinima, 4 * posts_->joint_inputs);
  if (boxes_ > most) boxes_ = 0;
  if (minima_ > most || split_ == ranks_.size()) minima_ = 0;
}

void PostMinima::find_ranges(std::size_t i, std::int64_t cell) {
  const PostTable& table = *posts_->tables[i];
  const std::size_t first = table.entry_of(*grid_, cell);
  std::vector<ResolvedRange>& different = different_[i];
  different.clear();
  window_[i] = {INT32_MAX, INT32_MIN};
  for (std::size_t offset = 0; offset < ranks_[i].size(); ++offset) {
    const ResolvedRange& range = posts_->resolved[i][first + offset];
    const auto known = std::find_if(different.begin(), different.end(),
                                    [&range](const ResolvedRange& other) { return same(range, other); });
    ranks_[i][offset] = known - different.begin();
    if (known != different.end()) continue;
    different.push_back(range);
    if (range.blocked || range.all_left()) continue;
    window_[i] = {std::min(window_[i].first, range.inside.first),
                  std::max(window_[i].last, range.inside.last)};
  }
  if (window_[i].first > window_[i].last) window_[i] = {0, 0};  // no post of this cell is looked at
}

}  // namespace coordreq
