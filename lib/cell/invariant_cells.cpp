#include "cell/invariant_cells.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

InvariantCells::InvariantCells(const SystemSpec& spec, std::span<const std::int32_t> delay) : delay_(delay) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.dynamics.is_kept(i)) stride_ *= at(spec.states[i].grid.count);
  }
  for (std::size_t begin = 0; begin < delay.size(); begin += kBlock) {
    before_.push_back(count_);
    const std::size_t end = std::min(begin + kBlock, delay.size());
    for (std::size_t x = begin; x < end; ++x) count_ += has(x) ? 1U : 0U;
  }
}

std::int64_t InvariantCells::draw(RandomStream& random) const {
  REQUIRES(count_ > 0);
  const std::uint64_t wanted = random.below(count_);
  const auto block = std::upper_bound(before_.begin(), before_.end(), wanted) - before_.begin() - 1;
  std::uint64_t passed = before_[at(block)];
  std::size_t x = at(block) * kBlock;
  while (!has(x) || passed++ < wanted) ++x;
  return static_cast<std::int64_t>(x);
}

}  // namespace coordreq
