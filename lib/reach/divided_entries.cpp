#include "reach/divided_entries.hpp"

#include <span>
#include <utility>

#include "ranks/divided_loop.hpp"

namespace coordreq {

DividedEntries::DividedEntries(TransitionTable& table, Places places, ThreadTeam::Range local, Ranks* ranks)
    : table_(&table), places_(std::move(places)), local_(local), ranks_(ranks) {
  if (ranks != nullptr) local_entries_.resize(static_cast<std::size_t>(local.end - local.begin));
}

void DividedEntries::join() {
  if (ranks_ == nullptr) return;
  Odometer choice(places_.counts);
  exchange_all(*ranks_, choice.size(), local_.begin, std::span<const IndexRange>(local_entries_),
               [&](IndexRange entry) {
                 std::int64_t position = places_.first;
                 for (std::size_t v = 0; v < places_.strides.size(); ++v)
                   position += choice.indices()[v] * places_.strides[v];
                 if (IndexRange* const held = table_->held(position)) *held = entry;
                 choice.advance();
               });
  local_entries_ = {};
}

}  // namespace coordreq
