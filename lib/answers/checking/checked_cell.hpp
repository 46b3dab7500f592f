#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/cell_tubes.hpp"
#include "answers/checking/check_context.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/checking/permitted_inputs.hpp"
#include "answers/checking/tally.hpp"
#include "answers/step_codes.hpp"
#include "base/requires.hpp"

namespace coordreq {

/// One cell after the other, with the posts and C(x) that all checks use, straight from the definitions, one
/// joint input at a time. A pair whose tube is not safe has no post. One object a thread.
class CheckedCell {
 public:
  /// @pre unchecked: `context` outlives this object.
  explicit CheckedCell(const CheckContext& context);

  void go_to(std::int64_t cell);

  [[nodiscard]] std::int64_t number() const { return cell_; }
  [[nodiscard]] std::size_t at() const { return static_cast<std::size_t>(cell_); }
  /// "x1 = 0.1, x2 = 0".
  [[nodiscard]] std::string location() const;
  /// Whether the file claims that the cell is in S.
  [[nodiscard]] bool is_safe() const { return safe_[at()] != 0; }
  /// Whether the file claims that the cell is in K; a cell outside S is not.
  [[nodiscard]] bool is_invariant() const { return is_safe() && invariant_[at()] != 0; }

  /// Whether the file claims that the cell is in a goal that ends the task. It counts as T, and nothing is
  /// required of the cells that follow.
  [[nodiscard]] bool is_terminal() const { return arrival_ != nullptr && (*arrival_)[at()] == 0; }

  /// C(x): [joint input] 1 or 0; all 0 outside K.
  [[nodiscard]] const std::vector<std::uint8_t>& admitted() const { return admitted_; }
  /// Whether every allowed joint input keeps the cell in K. @pre is_invariant()
  [[nodiscard]] bool all_stay() const {
    REQUIRES(is_invariant());
    return all_stay_;
  }

  /// Minima requested and cells looked at for them, so far: a measure of the work.
  [[nodiscard]] std::int64_t looked_at() const { return posts_.looked_at(); }

  // @pre unchecked: for the functions below, is_safe()
  [[nodiscard]] bool is_allowed(std::int64_t u) {
    return !is_forbidden(u) && (!listed_ || listed_->test(cell_, u));
  }
  /// Whether `allow` does not permit u, which then counts as blocked where classes act independently. A joint
  /// input that a controller file does not list is not forbidden.
  [[nodiscard]] bool is_forbidden(std::int64_t u) { return allow_ && !allow_->holds(u); }
  /// Whether the tube under u is safe; true if only samples count.
  [[nodiscard]] bool is_tube_safe(std::int64_t u) { return !tubes_ || tubes_->is_safe(u); }
  /// min over y in f(x, u) of values[y]; `forever` if the post has left safely, `blocked` if there is none.
  /// @param values over all cells; minima are remembered by the address of the values
  /// @pre unchecked: for the same values the same `blocked` and `forever`.
  template <class Value>
  [[nodiscard]] std::int32_t least(std::int64_t u, const std::vector<Value>& values, std::int32_t blocked,
                                   std::int32_t forever = kUnbounded) {
    if (remembered_ != values.data()) {
      remembered_ = values.data();
      memory_.assign(posts_.memory_size(), PostMinima::kNotKnown);
    }
    const std::int32_t value = posts_.least(u, values, blocked, forever, memory_);
    return value != blocked && !is_tube_safe(u) ? blocked : value;
  }

 private:
  void find_admitted();

  const CheckContext& context_;
  const std::vector<std::uint8_t>& safe_;
  const std::vector<std::uint8_t>& invariant_;
  const std::vector<std::int32_t>& delay_;    ///< of the first partition
  const std::vector<std::int32_t>* arrival_;  ///< where a goal ends the task, else null
  PostMinima posts_;
  std::optional<CellTubes> tubes_;            ///< if tubes count
  const std::optional<PackedPairs>& listed_;  ///< by the controller file; nothing: the spec has none
  std::optional<PermittedInputs> allow_;      ///< nothing: all joint inputs are allowed
  std::int64_t cell_ = 0;
  bool all_stay_ = false;
  std::vector<std::uint8_t> admitted_;
  std::vector<std::int32_t> memory_;  ///< the minima that posts_ remembers
  const void* remembered_ = nullptr;  ///< the values that memory_ is for
};

/// Adds a wrong claim to the tally.
void add_wrong(Tally& tally, const CheckedCell& cell, const char* what);
/// Adds a wrong claim about steps, coded as in `/delay`, to the tally.
void add_wrong_steps(Tally& tally, const CheckedCell& cell, std::int32_t claimed, std::int32_t expected);
/// Adds stored choices to the tally, those that are missing as open if posts may be others than those of the
/// analysis. @param label "actions", or empty
void add_choices(const CheckContext& context, Tally& tally, const CheckedCell& cell,
                 const BitDifference& difference, const std::string& label);

}  // namespace coordreq
