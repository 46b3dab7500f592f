#include "reach/divided_entries.hpp"

#include <span>
#include <utility>

#include "ranks/divided_loop.hpp"

namespace coordreq {

DividedEntries::DividedEntries(TransitionTable& table, Positions positions, ThreadTeam::Range local,
                               Ranks* ranks)
    : table_(&table), positions_(std::move(positions)), local_(local), ranks_(ranks) {
  if (ranks != nullptr) local_entries_.resize(static_cast<std::size_t>(local.end - local.begin));
}

void DividedEntries::join() {
  if (ranks_ == nullptr) return;
  Odometer choice(positions_.counts);
  exchange_all(*ranks_, choice.size(), local_.begin, std::span<const IndexRange>(local_entries_),
               [&](IndexRange entry) {
                 std::int64_t position = positions_.first;
                 for (std::size_t v = 0; v < positions_.strides.size(); ++v)
                   position += choice.indices()[v] * positions_.strides[v];
                 if (IndexRange* const held = table_->held(position)) *held = entry;
                 choice.advance();
               });
  local_entries_ = {};
}

}  // namespace coordreq
