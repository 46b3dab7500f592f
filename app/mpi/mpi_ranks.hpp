#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ranks/ranks.hpp"

namespace coordreq {

/// The processes that mpirun has started. At most one object a process: it begins and ends MPI.
///
/// An error of one rank ends all of them, and is reported once, by the first: see end_all().
class MpiRanks final : public Ranks {
 public:
  MpiRanks(int& argc, char**& argv);
  ~MpiRanks() override;
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int count() const override { return count_; }
  void send(int to, Bytes message) override;
  [[nodiscard]] Bytes receive(int from) override;
  [[nodiscard]] bool has_message(int from) override;
  [[nodiscard]] int on_this_machine() const override { return on_this_machine_; }
  [[nodiscard]] std::int64_t sent_bytes() const override { return sent_bytes_; }
  void add(std::span<std::int64_t> values) override;
  void take_greatest(std::span<std::int64_t> values) override;
  void begin_sum(std::int64_t value) override;
  [[nodiscard]] std::int64_t finish_sum() override;

  /// Called while this rank waits; what it throws ends the wait.
  void set_watch(std::function<void()> watch) { watch_ = std::move(watch); }

  /// Completes messages in transit, and checks for errors of others. @throws Error of another rank
  void poll();

  /// Together: the work is done.
  void finish();
  /// The work has failed here. The first rank has said so and ends all processes; another one leaves both to
  /// the first, and if that does not receive it in some seconds `say` is called here.
  [[noreturn]] void end_all(int exit_code, const std::string& what, const std::function<void()>& say);

 private:
  /// The types of MPI are known in the source only.
  struct Sending;
  struct Handles;

  template <class Request>
  void wait(Request& request);
  void reduce(std::span<std::int64_t> values, bool is_sum);
  void forget_sent();
  void receive_errors();
  void idle();

  int rank_ = 0;
  int count_ = 1;
  int on_this_machine_ = 1;
  std::int64_t sent_bytes_ = 0;
  std::function<void()> watch_;
  std::deque<Sending> sending_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace coordreq
