#include "ranks/divided_loop.hpp"

#include <exception>

namespace coordreq {

ThreadTeam::Range divided_range(const Ranks* ranks, std::int64_t count) {
  if (ranks == nullptr) return {0, count};
  const std::int64_t all = ranks->count();
  const auto first = [&](std::int64_t rank) { return count / all * rank + count % all * rank / all; };
  return {first(ranks->rank()), first(ranks->rank() + 1)};
}

void for_each_divided(Ranks* ranks, ThreadTeam& team, std::int64_t count, std::int64_t grain,
                      const ThreadTeam::Body& body) {
  if (ranks == nullptr) return team.for_each(count, grain, body);
  const std::int64_t all = ranks->count();
  const auto [begin, end] = divided_range(ranks, count);
  std::exception_ptr error;
  try {
    team.for_each(end - begin, grain, [&, first = begin](ThreadTeam::Range range, int worker) {
      body({first + range.begin, first + range.end}, worker);
    });
  } catch (...) {
    error = std::current_exception();
  }
  const std::int64_t from_last = ranks->greatest(error ? all - ranks->rank() : 0);
  if (from_last == 0) return;
  if (from_last == all - ranks->rank()) std::rethrow_exception(error);
  static_cast<void>(ranks->greatest(0));  // ended by the one that throws
}

}  // namespace coordreq
