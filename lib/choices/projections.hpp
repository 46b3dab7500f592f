#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "base/zeroed_array.hpp"
#include "choices/controller.hpp"
#include "choices/independent_posts.hpp"
#include "engine/cell_set.hpp"
#include "engine/equal_work.hpp"
#include "engine/pair_table.hpp"

namespace coordreq {

/// The rules of the agents of a class (contract, section 9), each over inputs of its own.
struct ClassRules {
  /// Some agent has no rule: the actions of the class are in the projection of C(x), too.
  bool asks_controller = false;
  /// Rules that do not permit all actions: indices into ActionGrouping::sources(), and the agent of each.
  std::vector<std::size_t> sources;
  std::vector<std::size_t> agents;
  std::size_t agent = 0;  ///< named where the class has no action, though no single rule forbids all
};

/// The rules by which the classes of a partition act instead of by C.
struct SilentRules {
  const CellSet* cells = nullptr;        ///< the cells in which the rules are asked for
  std::vector<ClassRules> classes;       ///< [class] of the grouping
  std::vector<const PairTable*> tables;  ///< [source]; null: the source is no rule
  /// [agent] Number of cells in own rows in which its class is the first without an action; null: not
  /// counted.
  std::vector<std::atomic<std::int64_t>>* without_action = nullptr;

  /// Whether every class may take all of its actions in all cells.
  [[nodiscard]] bool permit_all() const {
    for (const ClassRules& rules : classes) {
      if (rules.asks_controller || !rules.sources.empty()) return false;
    }
    return true;
  }
};

/// The projections of C onto the classes of one partition: IND_C(x) is their product (paper, Eq. (4); with
/// every agent by itself Eq. (3)). Held for each row that this process owns, in the form with the least work.
///
/// Example: one vehicle may brake (-1), roll (0) or accelerate (1), and so may the other. In a cell x where
/// both are as far from the crossing only one of them may go first, C(x) = {(1, -1), (-1, 1), (-1, -1)}:
///
///     projection on the first   {-1, 1}       some action of the second fits each of them
///     projection on the second  {-1, 1}
///     IND_C(x)                  {(-1, -1), (-1, 1), (1, -1), (1, 1)}
///
/// (1, 1) is in IND_C(x), not in C(x): each of them may have meant to go first. If it leads out of K, the
/// delay of x is 0.
class Projections {
 public:
  /// @param equal with a symmetry nothing is held of rows that are not canonical, and nothing may be asked of
  ///   them. Without `numbers` those of the tables are taken; where the controller is a part of C, numbers
  ///   have to tell rows apart in which K differs
  /// @param keeps_masks whether mask() is there also for rows in the form of a product
  Projections(const Controller& controller, const ActionGrouping& grouping, ThreadTeam& team,
              const EqualWork& equal = {}, bool keeps_masks = false);
  /// Projections by rules instead of C: for the cells in which rules are asked for, the actions that each
  /// class may take. forbidden() has the cells where a class has no action, or all classes together may take
  /// a forbidden joint input.
  /// @pre unchecked: the grouping tells actions apart by the rules, too.
  Projections(const Controller& controller, const ActionGrouping& grouping, ThreadTeam& team,
              const SilentRules& rules);
  Projections(Projections&&) = default;  // members of found_ point into stores_
  Projections& operator=(Projections&&) = default;
  Projections(const Projections&) = delete;
  Projections& operator=(const Projections&) = delete;
  ~Projections() = default;

  [[nodiscard]] const ActionGrouping& grouping() const { return *grouping_; }
  enum class Form : std::uint8_t {
    full,     ///< every action of each class is in its projection for all x of K in the row
    masks,    ///< a row of bits for each group of actions of each class, see mask()
    product,  ///< boxes of posts for parts of the row, see IndependentPosts
  };
  [[nodiscard]] Form form(std::int64_t row) const {
    const std::uint32_t number = number_[static_cast<std::size_t>(row)];
    if (number == kNothing) return Form::full;
    if (!found_[number - 1].packed.empty()) return Form::product;
    return found_[number - 1].masks.empty() ? Form::full : Form::masks;
  }
  /// Whether every action of each class is in its projection for all x of K in the row, whatever its form.
  [[nodiscard]] bool is_full(std::int64_t row) const {
    return number_[static_cast<std::size_t>(row)] == kNothing || of(row).is_full;
  }
  /// {x in the row : group g of class c is in the projection of C(x)}; groups as ActionGrouping::group
  /// numbers them. @pre form(row) is `masks`, or masks are kept and the row is not full
  [[nodiscard]] ConstRow mask(std::int64_t row, const RowGroups& groups, std::size_t c,
                              std::uint32_t g) const;
  /// For IndependentPosts::unpack(). The boxes are those of a row that is equal seen from itself: they have
  /// to be moved by find_shift(). @pre form(row) is `product`
  [[nodiscard]] ConstRow packed(std::int64_t row) const {
    REQUIRES(form(row) == Form::product);
    return of(row).packed;
  }
  /// The cells of the row where IND_C holds a forbidden joint input; with rules also the cells where it is
  /// empty. Empty if there are no such cells.
  [[nodiscard]] ConstRow forbidden(std::int64_t row) const {
    return number_[static_cast<std::size_t>(row)] == kNothing ? ConstRow() : of(row).forbidden;
  }
  /// The shift of the boxes of packed(). @returns whether boxes have to be moved
  bool find_shift(std::int64_t row, std::vector<std::int32_t>& shift) const {
    const std::int64_t first = rows_[number_[static_cast<std::size_t>(row)] - 1];
    if (first != row) equal_.tiles->find_shift(first, row, shift);
    return first != row;
  }

  /// Equal work of the operator of IND_C.
  [[nodiscard]] const EqualWork& equal_work() const { return equal_; }

 private:
  static constexpr std::uint32_t kNothing = 0;
  static constexpr std::uint32_t kFound = 1;  ///< while rows are numbered: K has a cell in it
  template <class Level>
  class Builder;
  void find_all(const Controller& controller, ThreadTeam& team, const SilentRules* rules, bool keeps_masks);
  /// Keeps lists of words one behind the other, at fixed addresses: an allocation for each row would take
  /// more memory than its words.
  class Store {
   public:
    [[nodiscard]] std::span<const Word> keep(std::span<const Word> list);

   private:
    /// A block is twice as long as the last one, up to a limit: each of many threads keeps few lists.
    static constexpr std::size_t kFirstBlock = std::size_t{1} << 9, kMostBlock = std::size_t{1} << 15;
    std::vector<std::vector<Word>> blocks_;
  };
  /// The projections of one row, and of all rows equal to it.
  struct Found {
    bool is_full = false;
    std::span<const Word> packed = {};     ///< of a product, see Projections::packed()
    std::span<const Word> masks = {};      ///< groups of class 0, then of class 1, ...
    std::span<const Word> forbidden = {};  ///< see Projections::forbidden()
  };

  [[nodiscard]] const Found& of(std::int64_t row) const {
    return found_[number_[static_cast<std::size_t>(row)] - 1];
  }
  void number_rows_of(const CellSet& invariant, const EqualWork& equal, const RowShare* share,
                      ThreadTeam& team);
  [[nodiscard]] bool has_cells(const CellSet& invariant, std::int64_t row) const;

  const ActionGrouping* grouping_;
  std::size_t words_;
  EqualWork equal_;
  Tiles::Numbers classes_;  ///< [tile] equal numbers where projections are the same
  ZeroedArray<std::uint32_t>
      number_;  ///< [row] 1 + its index in `found_`, or kNothing if K has no cell in the row
  std::vector<std::int64_t> rows_;  ///< [index in `found_`] the first row of this kind
  ZeroedArray<Found> found_;
  std::vector<Store> stores_;  ///< [worker] the words of `found_`
};

}  // namespace coordreq
