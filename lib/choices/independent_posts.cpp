#include "choices/independent_posts.hpp"

#include <algorithm>

namespace coordreq {
namespace {

/// Words that so many bytes take.
std::size_t words_of(std::size_t bytes) {
  return (bytes + sizeof(Word) - 1) / sizeof(Word);
}

}  // namespace

/// Finds the groups that can make a difference: reasonable in some cell, with a post inside the domain, and
/// without another group whose post holds theirs and that is reasonable in all of their cells.
void IndependentPosts::find_worst(const RowBoxes& boxes, const ActionGroups& groups, std::size_t c,
                                  const std::vector<Word>& masks) {
  worst_.clear();
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const ConstRow mask = mask_of(masks, g);
    bool needed = boxes.kind(c, g) == RowBoxes::Kind::box && any_set(mask);
    for (const std::uint32_t h : groups.holders[g]) {
      if (!needed) break;
      if (boxes.kind(c, h) != RowBoxes::Kind::box) continue;
      const ConstRow other = mask_of(masks, h);
      if (!is_subset(mask, other)) continue;
      // The lower one of two groups that cover each other stays.
      needed = groups.is_within(h, g) && g < h && is_subset(other, mask);
    }
    if (needed) worst_.push_back(g);
  }
}

/// Cuts the row into subsets, in each of which the same of the worst groups are reasonable.
void IndependentPosts::find_subsets(const std::vector<Word>& masks, ConstRow invariant) {
  subsets_ = 1;
  subset_masks_.assign(invariant.begin(), invariant.end());
  subset_groups_.assign(worst_.size(), 0);
  const std::size_t groups = worst_.size();
  for (std::size_t k = 0; k < groups; ++k) {
    const ConstRow mask = mask_of(masks, worst_[k]);
    const std::size_t before = subsets_;
    for (std::size_t p = 0; p < before; ++p) {
      const int overlap = kernels_->compare(subset_masks_.data() + p * words_, mask.data(), words_);
      const bool is_inside_mask = overlap == 1;
      if (overlap == 3) split_subset(p, mask);
      if ((overlap & 1) != 0) subset_groups_[(is_inside_mask ? p : subsets_ - 1) * groups + k] = 1;
    }
  }
}

/// Moves the cells of `mask` from a subset to a new one with the same groups.
void IndependentPosts::split_subset(std::size_t p, ConstRow mask) {
  const std::size_t groups = worst_.size();
  subset_masks_.resize((subsets_ + 1) * words_);
  subset_groups_.resize((subsets_ + 1) * groups);
  Word* const subset = subset_masks_.data() + p * words_;
  Word* const other = subset_masks_.data() + subsets_ * words_;
  for (std::size_t w = 0; w < words_; ++w) {
    other[w] = subset[w] & mask[w];
    subset[w] &= ~mask[w];
  }
  std::copy_n(subset_groups_.data() + p * groups, groups, subset_groups_.data() + subsets_ * groups);
  ++subsets_;
}

/// Finds the boxes that the groups of each subset fill together; subsets with equal boxes become one.
void IndependentPosts::find_lists(const RowBoxes& boxes, std::size_t c, ClassLists& class_lists) {
  class_lists.lists.clear();
  class_lists.masks.clear();
  for (std::size_t p = 0; p < subsets_; ++p) {
    list_.dimensions = boxes.moved(c).size();
    list_.ranges.clear();
    for (std::size_t k = 0; k < worst_.size(); ++k) {
      if (subset_groups_[p * worst_.size() + k] == 0) continue;
      const auto ranges = boxes.ranges(c, worst_[k]);
      list_.ranges.insert(list_.ranges.end(), ranges.begin(), ranges.end());
    }
    if (list_.ranges.empty()) continue;  // all of its actions in the subset leave for good
    if (joins_boxes_) merge_boxes(list_, longest_);
    const auto known = std::find_if(class_lists.lists.begin(), class_lists.lists.end(),
                                    [&](const BoxList& other) { return other.ranges == list_.ranges; });
    const auto number = static_cast<std::size_t>(known - class_lists.lists.begin());
    if (known == class_lists.lists.end()) {
      class_lists.lists.push_back(list_);
      class_lists.masks.resize(class_lists.masks.size() + words_, 0);
    }
    for (std::size_t w = 0; w < words_; ++w)
      class_lists.masks[number * words_ + w] |= subset_masks_[p * words_ + w];
  }
}

/// Numbers the combinations of the classes' subsets that occur.
void IndependentPosts::join_classes(ConstRow invariant) {
  std::size_t combinations = 1;
  for (const ClassLists& class_lists : classes_) combinations *= class_lists.lists.size();
  joint_.clear();
  is_whole_ =
      combinations == 1 && std::all_of(classes_.begin(), classes_.end(), [&](const ClassLists& class_lists) {
        return is_subset(invariant, class_lists.masks);
      });
  if (is_whole_) joint_.push_back({0, 0, std::vector<std::uint32_t>(classes_.size(), 0)});
  if (is_whole_ || combinations == 0) return;
  labels_.assign(lanes(), 0);
  // One AND a combination, or some looks a lane.
  if (combinations < CellSet::kWordBits) {
    mask_.assign((classes_.size() + 1) * words_, 0);
    std::copy(invariant.begin(), invariant.end(), mask_.begin());
    chosen_.clear();
    join_masks(0);
  } else {
    join_lanes();
  }
}

void IndependentPosts::join_masks(std::size_t c) {
  const Word* const mask = mask_.data() + c * words_;
  if (c == classes_.size()) {
    joint_.push_back({INT64_MAX, 0, chosen_});
    JointSubset& subset = joint_.back();
    for_each_bit({mask, words_}, [&](std::int64_t lane) {
      labels_[static_cast<std::size_t>(lane)] = static_cast<std::int32_t>(joint_.size());
      subset.begin = std::min(subset.begin, lane);
      subset.end = lane + 1;
    });
    return;
  }
  for (std::size_t i = 0; i < classes_[c].lists.size(); ++i) {
    const Word* const class_mask = classes_[c].masks.data() + i * words_;
    Word* const both = mask_.data() + (c + 1) * words_;
    Word any = 0;
    for (std::size_t w = 0; w < words_; ++w) any |= both[w] = mask[w] & class_mask[w];
    if (any == 0) continue;
    chosen_.push_back(static_cast<std::uint32_t>(i));
    join_masks(c + 1);
    chosen_.pop_back();
  }
}

void IndependentPosts::join_lanes() {
  joint_.assign(1, {0, 0, {}});
  labels_.assign(lanes(), 1);
  for (const ClassLists& class_lists : classes_) {
    class_labels_.assign(lanes(), 0);
    for (std::size_t i = 0; i < class_lists.lists.size(); ++i) {
      for_each_bit({class_lists.masks.data() + i * words_, words_}, [&](std::int64_t lane) {
        class_labels_[static_cast<std::size_t>(lane)] = static_cast<std::uint32_t>(i + 1);
      });
    }
    const std::size_t choices = class_lists.lists.size() + 1;
    joint_before_.swap(joint_);
    joint_.clear();
    numbers_.assign((joint_before_.size() + 1) * choices, 0);
    for (std::size_t lane = 0; lane < labels_.size(); ++lane) {
      std::int32_t& label = labels_[lane];
      if (label == 0 || class_labels_[lane] == 0) {
        label = 0;
        continue;
      }
      std::int32_t& number = numbers_[static_cast<std::size_t>(label) * choices + class_labels_[lane]];
      if (number == 0) {
        joint_.push_back(
            {static_cast<std::int64_t>(lane), 0, joint_before_[static_cast<std::size_t>(label) - 1].lists});
        joint_.back().lists.push_back(class_labels_[lane] - 1);
        number = static_cast<std::int32_t>(joint_.size());
      }
      label = number;
      joint_[static_cast<std::size_t>(number) - 1].end = static_cast<std::int64_t>(lane) + 1;
    }
  }
}

void IndependentPosts::pack(const RowBoxes& boxes, const RowGroups& groups,
                            const std::vector<std::vector<Word>>& masks, ConstRow invariant,
                            const UniformGrid& grid, std::vector<Word>& packed) {
  packed.clear();
  classes_.resize(groups.classes.size());
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    if (boxes.moved(c).empty()) {  // its actions move nothing: one list, for all cells
      classes_[c].lists.assign(1, {.dimensions = 0, .ranges = {}});
      classes_[c].masks.assign(invariant.begin(), invariant.end());
      continue;
    }
    longest_.clear();
    for (const std::size_t t : boxes.moved(c))
      longest_.push_back(grid[t].periodic() ? grid[t].count : INT32_MAX);
    find_worst(boxes, *groups.classes[c], c, masks[c]);
    find_subsets(masks[c], invariant);
    find_lists(boxes, c, classes_[c]);
  }
  join_classes(invariant);
  pack_lists(packed);
  pack_subsets(packed);
}

void IndependentPosts::pack_lists(std::vector<Word>& packed) const {
  for (const ClassLists& class_lists : classes_) {
    packed.push_back(class_lists.lists.size());
    for (const BoxList& list : class_lists.lists) {
      packed.push_back(list.dimensions == 0 ? 1 : list.size());
      for (const IndexRange& range : list.ranges) packed.push_back(pack_range(range));
    }
  }
}

void IndependentPosts::pack_subsets(std::vector<Word>& packed) const {
  packed.push_back(joint_.size());
  std::size_t offset = 0;
  std::vector<std::size_t> first_list;
  for (const ClassLists& class_lists : classes_) {
    first_list.push_back(offset);
    offset += class_lists.lists.size();
  }
  for (const JointSubset& subset : joint_) {
    packed.push_back(static_cast<Word>(subset.begin) | static_cast<Word>(subset.end) << 32U);
    for (std::size_t c = 0; c < subset.lists.size(); ++c) packed.push_back(first_list[c] + subset.lists[c]);
  }
  const std::size_t pages = is_whole_ ? 0 : (joint_.size() + kLabelsOfPage - 1) / kLabelsOfPage;
  packed.push_back(pages);
  for (std::size_t page = 0; page < pages; ++page) pack_labels(labels_, page, packed);
}

void IndependentPosts::pack_labels(const std::vector<std::int32_t>& labels, std::size_t page,
                                   std::vector<Word>& packed) {
  constexpr std::size_t kLongest = UINT8_MAX;
  const std::size_t before = page * kLabelsOfPage;
  const auto label_of = [&](std::size_t lane) {
    const auto label = static_cast<std::size_t>(labels[lane]);
    return label > before && label - before <= kLabelsOfPage ? label - before : 0;
  };
  std::vector<std::uint8_t> runs;
  for (std::size_t lane = 0; lane < labels.size();) {
    const std::size_t begin = lane, most = std::min(labels.size(), begin + kLongest), label = label_of(lane);
    while (lane < most && label_of(lane) == label) ++lane;
    runs.insert(runs.end(), {static_cast<std::uint8_t>(label), static_cast<std::uint8_t>(lane - begin)});
  }
  while (!runs.empty() && runs.end()[-2] == 0) runs.resize(runs.size() - 2);
  packed.push_back(runs.size());
  const std::size_t at = packed.size();
  packed.resize(at + words_of(runs.size()), 0);
  std::ranges::copy(runs, reinterpret_cast<std::uint8_t*>(packed.data() + at));
}

std::span<const std::uint8_t> IndependentPosts::page_at(std::span<const Word> packed, std::size_t& at) {
  const std::size_t bytes = packed[at++];
  const auto* const first = reinterpret_cast<const std::uint8_t*>(packed.data() + at);
  at += words_of(bytes);
  return {first, bytes};
}

void IndependentPosts::unpack(std::span<const Word> packed, const RowBoxes& boxes, std::size_t classes,
                              Row& row) {
  std::size_t at = 0;
  row.lists.clear();
  row.subsets.clear();
  row.pages.clear();
  for (std::size_t c = 0; c < classes; ++c) {
    for (Word left = packed[at++]; left > 0; --left) {
      const std::size_t count = packed[at++];
      const std::size_t size = count * boxes.moved(c).size();
      row.lists.push_back({packed.subspan(at, size), count});
      at += size;
    }
  }
  for (Word left = packed[at++]; left > 0; --left) {
    const Word range = packed[at++];
    row.subsets.push_back({static_cast<std::int64_t>(range & 0xFFFFFFFFU),
                           static_cast<std::int64_t>(range >> 32U), packed.subspan(at, classes)});
    at += classes;
  }
  for (Word left = packed[at++]; left > 0; --left) row.pages.push_back(page_at(packed, at));
}

}  // namespace coordreq
