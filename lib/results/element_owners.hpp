#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "answers/field.hpp"
#include "model/cell_order.hpp"
#include "ranks/row_share.hpp"

namespace coordreq {

/// Which of several processes knows which elements of an array.
class ElementOwners {
 public:
  using Visit = std::function<void(int owner, std::uint64_t first, std::uint64_t count)>;

  ElementOwners() = default;
  ElementOwners(const ElementOwners&) = delete;
  ElementOwners& operator=(const ElementOwners&) = delete;
  virtual ~ElementOwners() = default;

  [[nodiscard]] virtual int owner_of(std::uint64_t element) const = 0;
  /// Visits elements [begin, begin + count) in order, in runs of one owner.
  virtual void for_each_run(std::uint64_t begin, std::uint64_t count, const Visit& visit) const = 0;
};

/// The owners of an array of cells: the processes that own the rows of the cells.
class CellOwners : public ElementOwners {
 public:
  /// @param of_cell elements of each cell. @pre unchecked: the others outlive this object.
  CellOwners(const RowShare& share, const CellOrder& order, std::uint64_t of_cell)
      : share_(share), order_(order), of_cell_(of_cell) {}

  [[nodiscard]] int owner_of(std::uint64_t element) const override;
  void for_each_run(std::uint64_t begin, std::uint64_t count, const Visit& visit) const override;

 private:
  const RowShare& share_;
  const CellOrder& order_;
  std::uint64_t of_cell_;
};

/// The owners of lists of cells that are stored one after the other: each process has some neighbouring cells
/// of each list.
class ListOwners : public ElementOwners {
 public:
  /// @param sizes [list, rank] how many cells the process has
  ListOwners(const std::vector<std::int64_t>& sizes, int ranks);

  [[nodiscard]] int owner_of(std::uint64_t element) const override;
  void for_each_run(std::uint64_t begin, std::uint64_t count, const Visit& visit) const override;

 private:
  [[nodiscard]] std::size_t run_of_element(std::uint64_t element) const;

  std::size_t ranks_;
  std::vector<std::uint64_t> start_;  ///< [list * ranks + rank], and the end
};

}  // namespace coordreq
