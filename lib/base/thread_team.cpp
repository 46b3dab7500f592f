#include "base/thread_team.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace coordreq {

struct ThreadTeam::State {
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable finished;
  std::vector<std::thread> threads;
  std::uint64_t generation = 0;  // counts loops; a helper runs each generation once
  int busy = 0;
  bool stopping = false;

  const Body* body = nullptr;
  std::int64_t count = 0;
  std::int64_t grain = 1;
  std::atomic<std::int64_t> next{0};
  std::exception_ptr failure;
  std::int64_t failed_at = 0;

  void run(int worker) {
    for (;;) {
      const std::int64_t begin = next.fetch_add(grain, std::memory_order_relaxed);
      if (begin >= count) return;
      try {
        (*body)({begin, std::min(begin + grain, count)}, worker);
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
    std::uint64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        start.wait(lock, [&] { return stopping || generation != seen; });
        if (stopping) return;
        seen = generation;
      }
      run(worker);
      const std::lock_guard lock(mutex);
      if (--busy == 0) finished.notify_one();
    }
  }
};

ThreadTeam::ThreadTeam(int threads) : state_(std::make_unique<State>()) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int size = threads > 0 ? threads : cores;
  state_->threads.reserve(static_cast<std::size_t>(size - 1));
  for (int worker = 1; worker < size; ++worker) {
    try {
      state_->threads.emplace_back([state = state_.get(), worker] { state->help(worker); });
    } catch (const std::system_error&) {
      break;  // the system gives no more threads: work with those that started
    }
  }
}

ThreadTeam::~ThreadTeam() {
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
    for (std::int64_t begin = 0; begin < count; begin += grain)
      body({begin, std::min(begin + grain, count)}, 0);
    return;
  }
  {
    const std::lock_guard lock(state.mutex);
    state.body = &body;
    state.count = count;
    state.grain = grain;
    state.next.store(0, std::memory_order_relaxed);
    state.failure = nullptr;
    state.busy = static_cast<int>(state.threads.size());
    ++state.generation;
  }
  state.start.notify_all();
  state.run(0);
  std::unique_lock lock(state.mutex);
  state.finished.wait(lock, [&] { return state.busy == 0; });
  if (state.failure) std::rethrow_exception(state.failure);
}

}  // namespace coordreq
