#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_rows.hpp"

namespace coordreq {

/// LevelRows of the width that their finite levels need.
class LevelMap {
 public:
  /// Stands for the greatest level of whatever width is in use.
  static constexpr std::int64_t kTop = -1;

  LevelMap() = default;
  template <class Level>
  explicit LevelMap(LevelRows<Level> rows) : rows_(std::move(rows)) {}

  template <class Visit>
  decltype(auto) visit(const Visit& visit) const {
    return std::visit(visit, rows_);
  }

  /// The rows if they are of this width, else null.
  template <class Level>
  [[nodiscard]] LevelRows<Level>* get_if() {
    return std::get_if<LevelRows<Level>>(&rows_);
  }
  template <class Level>
  [[nodiscard]] const LevelRows<Level>* get_if() const {
    return std::get_if<LevelRows<Level>>(&rows_);
  }

  [[nodiscard]] std::int64_t rows() const {
    return visit([](const auto& levels) { return levels.rows(); });
  }
  [[nodiscard]] std::int64_t row_length() const {
    return visit([](const auto& levels) { return levels.row_length(); });
  }
  [[nodiscard]] std::int64_t cells() const { return rows() * row_length(); }
  /// Which rows are whose; null if there is one process.
  [[nodiscard]] const RowShare* share() const {
    return visit([](const auto& levels) { return levels.share(); });
  }
  /// Level of a cell (row-major linear index), kTop if it is never lost.
  [[nodiscard]] std::int64_t at(std::int64_t cell) const;
  /// Number of cells of each finite level 0, 1, ... up to the greatest that occurs, and of the cells never
  /// lost, of all processes.
  struct Histogram {
    std::vector<std::int64_t> finite;
    std::int64_t top = 0;
  };
  /// Together.
  [[nodiscard]] Histogram histogram(ThreadTeam& team) const;
  /// The cells with level kTop, in the rows that this process holds.
  [[nodiscard]] CellSet top_cells(ThreadTeam& team) const;

 private:
  std::variant<LevelRows<std::uint8_t>, LevelRows<std::uint16_t>, LevelRows<std::uint32_t>> rows_;
};

}  // namespace coordreq
