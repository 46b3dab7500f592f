#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/fast_paths.hpp"
#include "engine/bit_kernels.hpp"
#include "engine/merge_boxes.hpp"
#include "engine/row_boxes.hpp"

namespace coordreq {

/// The union of the posts under IND_C for one row, where posts are products: the cells of the row fall into
/// subsets, in each of which the classes have the same choices, and for each subset there is a list of boxes
/// for each class. The posts of a cell are products of a box for each class, so is their union, and a box
/// that several actions fill together is tested once (FastPaths::joined_boxes).
///
/// Subsets are distinguished by one label a cell, in pages: a row of the gridworld has some 44 subsets, at
/// steps of 5 mm up to 136.
class IndependentPosts {
 public:
  static constexpr std::size_t kLabelsOfPage = 255;  ///< 1, ..., 255; 0 for cells of other pages

  /// Boxes of one class, one after the other.
  struct Boxes {
    std::span<const Word> ranges;  ///< packed, for RowBoxes::put(); for each box one range for each dimension
                                   ///< that the class moves
    std::size_t count = 0;         ///< number of boxes; 1 for a class that moves no dimension
    [[nodiscard]] std::span<const Word> operator[](std::size_t i) const {
      const std::size_t dimensions = ranges.size() / count;
      return ranges.subspan(i * dimensions, dimensions);
    }
  };
  struct Subset {
    std::int64_t begin = 0;  ///< lanes of its cells are in [begin, end)
    std::int64_t end = 0;
    std::span<const Word> boxes;  ///< [class] index of its list in Row::lists
  };
  /// Views of a packed row.
  struct Row {
    std::vector<Subset> subsets;  ///< [page * kLabelsOfPage + label - 1]
    std::vector<Boxes> lists;
    /// [page] its labels, for put_labels(). Empty: there is one subset, all of K.
    std::vector<std::span<const std::uint8_t>> pages;
  };

  /// @param words of a row of bits
  explicit IndependentPosts(std::size_t words)
      : words_(words), kernels_(&bit_kernels(best_instruction_set())) {}

  /// Packs a row. @param masks [class][group * words], the projections of C on this row
  /// @param invariant K on this row
  void pack(const RowBoxes& boxes, const RowGroups& groups, const std::vector<std::vector<Word>>& masks,
            ConstRow invariant, const UniformGrid& grid, std::vector<Word>& packed);
  static void unpack(std::span<const Word> packed, const RowBoxes& boxes, std::size_t classes, Row& row);
  /// Adds the number of bytes, and the bytes, of the runs of lanes with one label: labels and lengths in
  /// turn.
  /// @param labels [lane] from 1 on in all pages; 0: none
  static void pack_labels(const std::vector<std::int32_t>& labels, std::size_t page,
                          std::vector<Word>& packed);
  /// The bytes that pack_labels() has added at `at`, which moves behind them.
  [[nodiscard]] static std::span<const std::uint8_t> page_at(std::span<const Word> packed, std::size_t& at);
  /// Writes the label of each lane of a row.
  template <class Level>
  static void put_labels(std::span<const std::uint8_t> page, std::vector<Level>& labels) {
    auto lane = labels.begin();
    for (std::size_t k = 0; k < page.size(); k += 2) lane = std::fill_n(lane, page[k + 1], Level{page[k]});
    std::fill(lane, labels.end(), Level{0});
  }

 private:
  /// The subsets of the row for one class.
  struct ClassLists {
    std::vector<BoxList> lists;  ///< different lists
    std::vector<Word> masks;     ///< [list * words_] the cells that have the list
  };

  void find_worst(const RowBoxes& boxes, const ActionGroups& groups, std::size_t c,
                  const std::vector<Word>& masks);
  void find_subsets(const std::vector<Word>& masks, ConstRow invariant);
  void split_subset(std::size_t p, ConstRow mask);
  void find_lists(const RowBoxes& boxes, std::size_t c, ClassLists& class_lists);
  void join_classes(ConstRow invariant);
  void join_masks(std::size_t c);
  void join_lanes();
  void pack_lists(std::vector<Word>& packed) const;
  void pack_subsets(std::vector<Word>& packed) const;

  [[nodiscard]] ConstRow mask_of(const std::vector<Word>& masks, std::uint32_t g) const {
    return {masks.data() + g * words_, words_};
  }
  [[nodiscard]] std::size_t lanes() const { return words_ * CellSet::kWordBits; }

  std::size_t words_;
  bool joins_boxes_ = fast_paths().joined_boxes;
  const BitKernels* kernels_;
  std::vector<std::uint32_t> worst_;
  std::vector<std::int64_t> longest_;
  BoxList list_;
  std::size_t subsets_ = 0;
  std::vector<Word> subset_masks_;  ///< [subset * words_]
  std::vector<std::uint8_t>
      subset_groups_;  ///< [subset * worst groups] 1 if the group is reasonable in the subset
  std::vector<ClassLists> classes_;
  std::vector<std::int32_t> labels_;  ///< [lane] 1 + number of its joint subset, or 0
  struct JointSubset {
    std::int64_t begin;
    std::int64_t end;
    std::vector<std::uint32_t> lists;  ///< [class]
  };
  bool is_whole_ = false;  ///< there is one joint subset, all of K
  std::vector<JointSubset> joint_;
  std::vector<JointSubset> joint_before_;
  std::vector<Word> mask_;             ///< [class * words_] cells of the choices so far
  std::vector<std::uint32_t> chosen_;  ///< [class] the choices so far
  std::vector<std::uint32_t> class_labels_;
  std::vector<std::int32_t> numbers_;
};

}  // namespace coordreq
