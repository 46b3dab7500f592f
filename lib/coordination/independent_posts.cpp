#include "coordination/independent_posts.hpp"

#include <algorithm>

namespace coordreq {

/// The groups that can make a difference: reasonable somewhere, with a post inside the domain, and not inside
/// that of another group that is reasonable wherever they are.
void IndependentPosts::find_worst(const RowBoxes& boxes, const ActionGroups& own, std::size_t c,
                                  const std::vector<Word>& masks) {
  worst_.clear();
  for (std::uint32_t g = 0; g < own.size(); ++g) {
    const ConstRow mask = mask_of(masks, g);
    bool needed = boxes.kind(c, g) == RowBoxes::Kind::box && any_set(mask);
    for (const std::uint32_t h : own.holders[g]) {
      if (!needed) break;
      if (boxes.kind(c, h) != RowBoxes::Kind::box) continue;
      const ConstRow other = mask_of(masks, h);
      if (!is_subset(mask, other)) continue;
      // Of two that cover each other the lower one stays.
      needed = own.is_within(h, g) && g < h && is_subset(other, mask);
    }
    if (needed) worst_.push_back(g);
  }
}

void IndependentPosts::pack(const RowBoxes& boxes, const RowGroups& groups,
                            const std::vector<std::vector<Word>>& masks, ConstRow invariant,
                            const UniformGrid& grid, std::vector<Word>& packed) {
  packed.clear();
  for (std::size_t c = 0; c < groups.classes.size(); ++c) {
    if (boxes.moved(c).empty()) {  // whatever it does makes no difference: one entry, for all cells
      packed.insert(packed.end(), {1, 1});
      continue;
    }
    longest_.clear();
    for (const std::size_t t : boxes.moved(c))
      longest_.push_back(grid[t].periodic() ? grid[t].count : INT32_MAX);
    find_worst(boxes, *groups.classes[c], c, masks[c]);
    const std::size_t place_of_count = packed.size();
    packed.push_back(0);
    Word count = 0;
    for (std::size_t k = 0; k < worst_.size(); ++k) {
      const ConstRow mask = mask_of(masks[c], worst_[k]);
      const bool is_known =
          std::any_of(worst_.begin(), worst_.begin() + static_cast<std::ptrdiff_t>(k),
                      [&](std::uint32_t h) { return std::ranges::equal(mask, mask_of(masks[c], h)); });
      if (!is_known) pack_mask(boxes, c, masks[c], mask, invariant, packed, count);
    }
    packed[place_of_count] = count;
  }
}

/// The boxes of all groups that are reasonable wherever `mask` is: more of them than needed, as others have
/// a smaller or larger mask of their own, but together they fill fewer boxes.
void IndependentPosts::pack_mask(const RowBoxes& boxes, std::size_t c, const std::vector<Word>& masks,
                                 ConstRow mask, ConstRow invariant, std::vector<Word>& packed, Word& count) {
  list_.dimensions = boxes.moved(c).size();
  list_.ranges.clear();
  for (const std::uint32_t g : worst_) {
    if (!is_subset(mask, mask_of(masks, g))) continue;
    const auto ranges = boxes.ranges(c, g);
    list_.ranges.insert(list_.ranges.end(), ranges.begin(), ranges.end());
  }
  merge_boxes(list_, longest_);
  const bool is_full = is_subset(invariant, mask);
  for (std::size_t i = 0; i < list_.size(); ++i) {
    packed.push_back(is_full ? 1 : 0);
    for (const IndexRange& range : list_[i]) packed.push_back(pack_range(range));
    if (!is_full) packed.insert(packed.end(), mask.begin(), mask.end());
    ++count;
  }
}

void IndependentPosts::unpack(std::span<const Word> packed, const RowBoxes& boxes, std::size_t words,
                              std::vector<std::vector<Entry>>& entries) {
  std::size_t at = 0;
  for (std::size_t c = 0; c < entries.size(); ++c) {
    entries[c].clear();
    const std::size_t dimensions = boxes.moved(c).size();
    const Word count = packed[at++];
    for (Word k = 0; k < count; ++k) {
      const bool is_full = packed[at++] != 0;
      Entry& entry = entries[c].emplace_back(Entry{.ranges = packed.subspan(at, dimensions), .mask = {}});
      at += dimensions;
      if (is_full) continue;
      entry.mask = packed.subspan(at, words);
      at += words;
    }
  }
}

}  // namespace coordreq
