#include "ranks/divided_loop.hpp"

#include <exception>

namespace coordreq {

void for_each_divided(Ranks* ranks, ThreadTeam& team, std::int64_t count, std::int64_t grain,
                      const ThreadTeam::Body& body) {
  if (ranks == nullptr) return team.for_each(count, grain, body);
  const std::int64_t all = ranks->count();
  const auto first = [&](std::int64_t rank) { return count / all * rank + count % all * rank / all; };
  const std::int64_t begin = first(ranks->rank());
  std::exception_ptr error;
  try {
    team.for_each(first(ranks->rank() + 1) - begin, grain, [&](ThreadTeam::Range range, int worker) {
      body({begin + range.begin, begin + range.end}, worker);
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
