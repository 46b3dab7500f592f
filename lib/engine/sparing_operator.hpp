#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "engine/cell_set.hpp"
#include "engine/row_operations.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// An operator that spares some cells: they are in every set, and the operator inside is not asked about
/// them. (The cells of a goal that ends the task, which count as T: contract, section 5.)
template <class Level>
class SparingOperator final : public RowOperator<Level> {
 public:
  /// @param spared cells of kTop, in the rows held; outlives this object
  SparingOperator(std::unique_ptr<RowOperator<Level>> others, const CellSet& spared, int workers)
      : others_(std::move(others)), spared_(spared), old_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override {
    const ConstRow spared = spared_.row(position.row);
    if (!any_set(spared)) return others_->next_levels(position, posts, old, next, worker);
    std::vector<Level>& rest = old_[static_cast<std::size_t>(worker)];
    rest.assign(old, old + posts.lanes());
    for_each_bit(spared, [&rest](std::int64_t x) { rest[static_cast<std::size_t>(x)] = 0; });
    if (!others_->next_levels(position, posts, rest.data(), next, worker)) return false;
    for_each_bit(spared, [next](std::int64_t x) { next[x] = PostReader<Level>::kTop; });
    return true;
  }
  [[nodiscard]] bool rises() const override { return others_->rises(); }
  [[nodiscard]] bool is_minimum() const override { return others_->is_minimum(); }

 private:
  std::unique_ptr<RowOperator<Level>> others_;
  const CellSet& spared_;
  std::vector<std::vector<Level>> old_;  ///< [worker] levels of the cells in question
};

}  // namespace coordreq
