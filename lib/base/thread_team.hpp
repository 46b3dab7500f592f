#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace coordreq {

/// A fixed set of threads that run loops together. One object is passed down explicitly; there is no global.
///
/// This class rather than TBB or OpenMP: ThreadSanitizer cannot see the synchronisation inside
/// those libraries and reports races that are none.
///
/// A loop calls as many of the threads as there are processors for, those first that wait already, and does
/// not wait for one that comes when nothing is left. So sixteen threads on two cores take hardly longer than
/// two.
///
/// Thread safety: `for_each` may be called from one thread at a time and not from within a loop body.
class ThreadTeam {
 public:
  /// A half-open range of loop indices.
  struct Range {
    std::int64_t begin = 0;
    std::int64_t end = 0;
  };
  /// `worker` in [0, size()) names the thread that runs the range, for scratch memory.
  using Body = std::function<void(Range range, int worker)>;
  /// Told how many of the indices of a loop have been handed out.
  using Watch = std::function<void(std::int64_t done, std::int64_t count)>;

  /// @param threads number of threads that work, the calling one included; 0 means all processors that
  ///   the process may use. Where the system refuses some, the team is smaller.
  explicit ThreadTeam(int threads = 0);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  [[nodiscard]] int size() const;

  /// Calls `body` on ranges of at most `grain` indices that together are [0, count), each index once.
  /// Returns when all are done. An exception thrown by a body ends the loop early and is rethrown here; of
  /// several the one of the lowest range, which is the same whatever the number of threads: ranges are handed
  /// out in order.
  void for_each(std::int64_t count, std::int64_t grain, const Body& body);

  /// From now on `watch` is called in every loop, by the thread that called for_each(), after each range that
  /// this thread has run; what it throws ends the loop like what a body throws. Empty: no call.
  void set_watch(Watch watch);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// ThreadTeam::for_each(), or with null as if by a team of this thread alone.
void for_each(ThreadTeam* team, std::int64_t count, std::int64_t grain, const ThreadTeam::Body& body);

}  // namespace coordreq
