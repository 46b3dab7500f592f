#include "base/thread_team.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/process_memory.hpp"
#include "base/short_wait.hpp"

namespace coordreq {

struct ThreadTeam::State {
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable finished;
  std::vector<std::thread> threads;
  int called = 0;            // helpers, by each loop
  std::atomic<int> open{0};  // calls of a loop that no helper has answered yet
  std::atomic<int> busy{0};  // calls that are open, or whose helper is still at work
  std::atomic<bool> stopping{false};
  std::atomic<std::size_t> started{0};  // helpers
  int sleeping = 0;                     // helpers that nobody has woken; under the mutex
  int woken = 0;                        // helpers that are yet to wake up; likewise
  bool main_sleeps = false;             // likewise
  ShortWait main_wait;                  // of the thread that calls for_each()

  const Body* body = nullptr;
  std::int64_t count = 0;
  std::int64_t grain = 1;
  std::atomic<std::int64_t> next{0};
  std::exception_ptr failure;
  std::int64_t failed_at = 0;
  Watch watch;

  void run(int worker) {
    for (;;) {
      const std::int64_t begin = next.fetch_add(grain, std::memory_order_relaxed);
      if (begin >= count) return;
      try {
        (*body)({begin, std::min(begin + grain, count)}, worker);
        if (worker == 0 && watch) watch(std::min(next.load(std::memory_order_relaxed), count), count);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure || begin < failed_at) {
          failure = std::current_exception();
          failed_at = begin;
        }
        next.store(count, std::memory_order_relaxed);
      }
    }
  }

  void help(int worker) {
    started.fetch_add(1);
    started.notify_one();
    ShortWait wait;
    for (;;) {
      const auto is_called = [&] { return stopping.load() || open.load() > 0; };
      if (!wait.comes_soon(is_called)) {
        std::unique_lock lock(mutex);
        if (!is_called()) sleep(lock);
      }
      if (stopping) return;
      if (!answer()) continue;
      run(worker);
      if (busy.fetch_sub(1) != 1) continue;
      const std::lock_guard lock(mutex);
      if (main_sleeps) finished.notify_one();
    }
  }

  void sleep(std::unique_lock<std::mutex>& lock) {
    ++sleeping;
    start.wait(lock, [&] { return stopping.load() || woken > 0; });
    --woken;
  }

  /// Takes a call. @returns false if none is open
  bool answer() {
    int left = open;
    while (left > 0 && !open.compare_exchange_weak(left, left - 1)) {
    }
    return left > 0;
  }

  /// The process may fork, and then the child must not wait for a lock that a thread held as it started: with
  /// AddressSanitizer it did.
  void wait_until_started() {
    for (std::size_t n = started; n < threads.size(); n = started) started.wait(n);
  }

  /// Helpers that are awake answer sooner than those that sleep, of which only as many are woken as are
  /// missing.
  void call_helpers() {
    const std::lock_guard lock(mutex);
    failure = nullptr;
    busy = called;
    open = called;
    for (int awake = static_cast<int>(threads.size()) - sleeping; awake < called; ++awake) {
      --sleeping;
      ++woken;
      start.notify_one();
    }
  }

  /// Calls that are still open are taken back: nothing is left to do.
  void wait_for_helpers() {
    busy -= open.exchange(0);
    const auto done = [&] { return busy.load() == 0; };
    if (main_wait.comes_soon(done)) return;
    std::unique_lock lock(mutex);
    main_sleeps = true;
    finished.wait(lock, done);
    main_sleeps = false;
  }
};

ThreadTeam::ThreadTeam(int threads) : state_(std::make_unique<State>()) {
  const int size = all_threads(threads);
  state_->threads.reserve(static_cast<std::size_t>(size - 1));
  if (size == 1) return;
  const LimitMove room_for_stacks;
  for (int worker = 1; worker < size; ++worker) {
    try {
      state_->threads.emplace_back([state = state_.get(), worker] { state->help(worker); });
    } catch (const std::system_error&) {
      break;  // the system gives no more threads: work with those that started
    }
  }
  state_->wait_until_started();
  // More threads than processors would wait for one another. On one processor one helper works all the same.
  state_->called = std::min(this->size(), std::max(2, usable_processors())) - 1;
}

ThreadTeam::~ThreadTeam() {
  if (state_->threads.empty()) return;
  const LimitMove stacks_go;
  {
    const std::lock_guard lock(state_->mutex);
    state_->stopping = true;
  }
  state_->start.notify_all();
  for (std::thread& thread : state_->threads) thread.join();
}

int ThreadTeam::size() const {
  return static_cast<int>(state_->threads.size()) + 1;
}

void ThreadTeam::for_each(std::int64_t count, std::int64_t grain, const Body& body) {
  if (count <= 0) return;
  State& state = *state_;
  grain = std::max<std::int64_t>(1, grain);
  if (state.threads.empty() || count <= grain) {
    for (std::int64_t begin = 0; begin < count; begin += grain) {
      const std::int64_t end = std::min(begin + grain, count);
      body({begin, end}, 0);
      if (state.watch) state.watch(end, count);
    }
    return;
  }
  state.body = &body;
  state.count = count;
  state.grain = grain;
  state.next.store(0, std::memory_order_relaxed);
  state.call_helpers();
  state.run(0);
  state.wait_for_helpers();
  if (state.failure) std::rethrow_exception(state.failure);
}

void for_each(ThreadTeam* team, std::int64_t count, std::int64_t grain, const ThreadTeam::Body& body) {
  if (team != nullptr) return team->for_each(count, grain, body);
  if (count > 0) body({0, count}, 0);
}

void ThreadTeam::set_watch(Watch watch) {
  state_->watch = std::move(watch);
}

}  // namespace coordreq
