#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "ranks/ranks.hpp"

namespace coordreq {

/// Ranks that are threads of one process. Where one of them throws, the others do too when they wait for it.
class ThreadRanks {
 public:
  /// Runs `work` as each of so many ranks. @throws what the lowest rank that failed by itself has thrown
  static void run(int count, const std::function<void(Ranks&)>& work) {
    Board board(count);
    std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
    std::vector<std::thread> threads;
    for (int r = 0; r < count; ++r) {
      threads.emplace_back([&, r] {
        One own(board, r);
        try {
          work(own);
        } catch (const Broken&) {
          board.give_up();
        } catch (...) {
          errors[static_cast<std::size_t>(r)] = std::current_exception();
          board.give_up();
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& error : errors) {
      if (error) std::rethrow_exception(error);
    }
    if (!board.is_empty()) throw std::logic_error("a message that nobody has received");
  }

 private:
  struct Broken {};

  class Board {
   public:
    explicit Board(int count) : count_(count) {}

    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] bool is_empty() const { return waiting_.empty(); }
    void give_up() {
      const std::lock_guard lock(mutex_);
      is_broken_ = true;
      changed_.notify_all();
    }
    void put(int from, int to, Bytes message) {
      const std::lock_guard lock(mutex_);
      waiting_[{from, to}].push_back(std::move(message));
      changed_.notify_all();
    }
    Bytes take(int from, int to) {
      std::unique_lock lock(mutex_);
      wait(lock, [&] { return waiting_.contains({from, to}); });
      const auto found = waiting_.find({from, to});
      Bytes message = std::move(found->second.front());
      found->second.pop_front();
      if (found->second.empty()) waiting_.erase(found);
      return message;
    }
    bool has(int from, int to) {
      const std::lock_guard lock(mutex_);
      return waiting_.contains({from, to});
    }
    void reduce(std::span<std::int64_t> values, std::int64_t (*join)(std::int64_t, std::int64_t)) {
      std::unique_lock lock(mutex_);
      const std::int64_t turn = turn_;
      if (here_ == 0) joined_.assign(values.begin(), values.end());
      if (joined_.size() != values.size()) throw std::logic_error("ranks reduce different things");
      for (std::size_t i = 0; here_ > 0 && i < values.size(); ++i) joined_[i] = join(joined_[i], values[i]);
      if (++here_ == count_) {
        here_ = 0;
        done_ = joined_;
        ++turn_;
        changed_.notify_all();
      }
      // Nobody is a turn ahead before all have taken what came of this one.
      wait(lock, [&] { return turn_ != turn; });
      std::copy(done_.begin(), done_.end(), values.begin());
    }

   private:
    template <class Condition>
    void wait(std::unique_lock<std::mutex>& lock, const Condition& condition) {
      changed_.wait(lock, [&] { return is_broken_ || condition(); });
      if (!condition()) throw Broken();
    }

    int count_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::pair<int, int>, std::deque<Bytes>> waiting_;
    bool is_broken_ = false;
    int here_ = 0;
    std::int64_t turn_ = 0;
    std::vector<std::int64_t> joined_, done_;
  };

  class One final : public Ranks {
   public:
    One(Board& board, int rank) : board_(board), rank_(rank) {}

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int count() const override { return board_.count(); }
    [[nodiscard]] int on_this_machine() const override { return board_.count(); }
    [[nodiscard]] std::int64_t sent_bytes() const override { return sent_bytes_; }
    void send(int to, Bytes message) override {
      sent_bytes_ += static_cast<std::int64_t>(message.size());
      board_.put(rank_, to, std::move(message));
    }
    [[nodiscard]] Bytes receive(int from) override { return board_.take(from, rank_); }
    [[nodiscard]] bool has_message(int from) override { return board_.has(from, rank_); }
    void add(std::span<std::int64_t> values) override {
      board_.reduce(values, [](std::int64_t a, std::int64_t b) { return a + b; });
    }
    void take_greatest(std::span<std::int64_t> values) override {
      board_.reduce(values, [](std::int64_t a, std::int64_t b) { return a < b ? b : a; });
    }
    void begin_sum(std::int64_t value) override { begun_ = value; }
    [[nodiscard]] std::int64_t finish_sum() override { return sum(begun_); }

   private:
    Board& board_;
    int rank_;
    std::int64_t begun_ = 0;
    std::int64_t sent_bytes_ = 0;
  };
};

}  // namespace coordreq
