#pragma once

#include <cstdint>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "cell/log_reader.hpp"
#include "model/locate.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Where the state of a log lies. Logs are rounded somewhere, at the latest to single precision, so that a
/// state that is within 1e-7 of its value (or of a step, if that is more) of a face counts in both cells: who
/// judges it gives it the benefit of the doubt.
struct LogPosition {
  std::vector<Rational> state;  ///< with what memories keep
  Location location;            ///< of just this state
  /// [dimension] the indices that it may have, the one of `location` first, also beyond the domain; none
  /// where a discrete state has no value of its grid.
  std::vector<std::vector<std::int64_t>> indices;
  /// Cells of the domain that the state may lie in, the one of `location` first; none outside of the domain.
  std::vector<std::int64_t> cells;

  /// No cell, and not because all is safe there.
  [[nodiscard]] bool is_outside() const {
    return cells.empty() && location.kind != Location::Kind::left_safely;
  }
};

/// Finds the cells of samples. What memories keep, if the log does not say it, follows from the cells before;
/// where there are none it is what it is at first.
class LogLocator {
 public:
  /// @pre unchecked: both outlive this object.
  LogLocator(const SystemSpec& spec, CellPosts& posts);

  /// @param before cells of the sample before; none: the log begins here
  [[nodiscard]] LogPosition position(const LogRow& row, const std::vector<std::int64_t>& before);

  /// How far a value in a log may be from the true one. @param step of its grid
  [[nodiscard]] static Rational slack(const Rational& value, const Rational& step);

 private:
  using Indices = std::vector<std::int64_t>;

  [[nodiscard]] Indices indices(std::size_t i, const Rational& value) const;
  [[nodiscard]] std::vector<Indices> kept_after(const LogRow& row, const std::vector<std::int64_t>& before);
  void add_cells(LogPosition& position, const std::vector<bool>& is_given, const Indices& kept) const;

  const SystemSpec& spec_;
  CellPosts& posts_;
  std::vector<UniformGrid> axes_;  ///< each dimension as a separate grid
};

}  // namespace coordreq
