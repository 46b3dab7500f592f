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
  std::atomic<std::uint64_t> generation{0};  // counts loops; a helper runs each generation once
  std::atomic<int> busy{0};
  std::atomic<bool> stopping{false};
  std::atomic<std::size_t> started{0};  // helpers
  int sleeping = 0;                     // helpers; under the mutex
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
    std::uint64_t seen = 0;
    ShortWait wait;
    for (;;) {
      const auto called = [&] { return stopping.load() || generation.load() != seen; };
      if (!wait.comes_soon(called)) {
        std::unique_lock lock(mutex);
        ++sleeping;
        start.wait(lock, called);
        --sleeping;
      }
      if (stopping) return;
      seen = generation;
      run(worker);
      if (busy.fetch_sub(1) != 1) continue;
      const std::lock_guard lock(mutex);
      if (main_sleeps) finished.notify_one();
    }
  }

  /// The process may fork, and then the child must not wait for a lock that a thread held as it started: with
  /// AddressSanitizer it did.
  void wait_until_started() {
    for (std::size_t n = started; n < threads.size(); n = started) started.wait(n);
  }

  void call_helpers() {
    const std::lock_guard lock(mutex);
    failure = nullptr;
    busy = static_cast<int>(threads.size());
    ++generation;
    if (sleeping > 0) start.notify_all();
  }

  void wait_for_helpers() {
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
