#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "safety/merge_boxes.hpp"
#include "safety/row_boxes.hpp"

namespace coordreq {

/// The union of the posts under IND_C for one row, where posts are products: for each class a list of boxes,
/// each with the cells of the row at which the class may go there. The posts of a cell are the product of
/// what its classes may do, so is their union, and a box that several actions fill together is tested once.
class IndependentPosts {
 public:
  /// One box of a class.
  struct Entry {
    std::span<const Word> ranges;  ///< packed, for RowBoxes::put()
    std::span<const Word> mask;    ///< cells of the row; empty: all cells of K
  };

  /// @param words of a bit row
  explicit IndependentPosts(std::size_t words) : words_(words) {}

  /// Packs a row. @param masks [class][group * words], the projections of C on this row
  /// @param invariant K on this row
  void pack(const RowBoxes& boxes, const RowGroups& groups, const std::vector<std::vector<Word>>& masks,
            ConstRow invariant, const UniformGrid& grid, std::vector<Word>& packed);
  /// Reads the entries of each class. The views are into `packed`.
  static void unpack(std::span<const Word> packed, const RowBoxes& boxes, std::size_t words,
                     std::vector<std::vector<Entry>>& entries);

 private:
  void find_worst(const RowBoxes& boxes, const ActionGroups& own, std::size_t c,
                  const std::vector<Word>& masks);
  void pack_mask(const RowBoxes& boxes, std::size_t c, const std::vector<Word>& masks, ConstRow mask,
                 ConstRow invariant, std::vector<Word>& packed, Word& count);

  [[nodiscard]] ConstRow mask_of(const std::vector<Word>& masks, std::uint32_t g) const {
    return {masks.data() + g * words_, words_};
  }

  std::size_t words_;
  std::vector<std::uint32_t> worst_;
  std::vector<std::int64_t> longest_;
  BoxList list_;
};

}  // namespace coordreq
