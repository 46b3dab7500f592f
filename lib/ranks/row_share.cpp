#include "ranks/row_share.hpp"

#include <utility>

namespace coordreq {
namespace {

using Range = RowShare::Range;

/// The runs of marked rows within a range.
std::vector<Range> marked_runs(const std::vector<std::uint8_t>& is_marked, Range within) {
  std::vector<Range> runs;
  for (std::int64_t row = within.begin; row < within.end; ++row) {
    if (is_marked[static_cast<std::size_t>(row)] == 0) continue;
    if (runs.empty() || runs.back().end != row) runs.push_back({row, row});
    ++runs.back().end;
  }
  return runs;
}

Bytes message_of(const std::vector<Range>& runs) {
  std::vector<std::int64_t> numbers;
  for (const Range run : runs) numbers.insert(numbers.end(), {run.begin, run.end});
  Bytes message;
  put_numbers<std::int64_t>(message, numbers);
  return message;
}

std::vector<Range> runs_of(const Bytes& message) {
  std::vector<Range> runs;
  for (MessageReader reader(message); !reader.is_at_end();) {
    const std::int64_t begin = reader.number();
    runs.push_back({begin, reader.number()});
  }
  return runs;
}

}  // namespace

RowShare::RowShare(Ranks& ranks, std::vector<std::int64_t> bounds)
    : ranks_(&ranks), bounds_(std::move(bounds)), held_{local()} {}

void RowShare::set_ghosts(const std::vector<std::uint8_t>& is_reachable) {
  peers_.clear();
  held_.clear();
  for (int r = 0; r < ranks_->count(); ++r) {
    if (r == ranks_->rank()) {
      held_.push_back(local());
      continue;
    }
    Peer peer{.rank = r, .sent = {}, .received = marked_runs(is_reachable, run_of(r))};
    held_.insert(held_.end(), peer.received.begin(), peer.received.end());
    ranks_->send(r, message_of(peer.received));
    peers_.push_back(std::move(peer));
  }
  for (Peer& peer : peers_) peer.sent = runs_of(ranks_->receive(peer.rank));
  std::erase_if(peers_, [](const Peer& peer) { return peer.sent.empty() && peer.received.empty(); });
}

std::vector<Range> ghost_rows(const RowShare& share) {
  std::vector<Range> runs = share.held();
  std::erase_if(
      runs, [local = share.local()](Range run) { return local.begin <= run.begin && run.end <= local.end; });
  return runs;
}

void for_each_row_of(ThreadTeam& team, const std::vector<Range>& runs, std::int64_t grain,
                     const ThreadTeam::Body& body) {
  std::vector<Range> blocks;
  for (const Range run : runs) {
    for (std::int64_t begin = run.begin; begin < run.end; begin += grain)
      blocks.push_back({begin, std::min(begin + grain, run.end)});
  }
  team.for_each(static_cast<std::int64_t>(blocks.size()), 1, [&](Range range, int worker) {
    for (std::int64_t i = range.begin; i < range.end; ++i) body(blocks[static_cast<std::size_t>(i)], worker);
  });
}

void for_each_local_row(ThreadTeam& team, const RowShare* share, std::int64_t rows, std::int64_t grain,
                        const ThreadTeam::Body& body) {
  const Range local = local_rows(share, rows);
  team.for_each(local.end - local.begin, grain, [&](Range range, int worker) {
    body({local.begin + range.begin, local.begin + range.end}, worker);
  });
}

void for_each_held_row(ThreadTeam& team, const RowShare* share, std::int64_t rows, std::int64_t grain,
                       const ThreadTeam::Body& body) {
  if (share == nullptr) return team.for_each(rows, grain, body);
  if (grain < rows) return for_each_row_of(team, share->held(), grain, body);
  for (const Range run : share->held()) body(run, 0);
}

}  // namespace coordreq
