#include "app/mpi/mpi_ranks.hpp"

#include <mpi.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "base/error.hpp"

namespace coordreq {
namespace {

/// MPI counts in ints: longer messages go in pieces of this size, and one that is not longer is the last.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;
/// How long a rank waits for the first one to receive its error: after that it reports it itself.
constexpr std::chrono::seconds kPatience{20};
/// How long it waits for somebody to read its last line who is there and does not.
constexpr std::chrono::seconds kLineIsRead{60};

/// The launcher reads standard error from a pipe, and that of MPICH drops what it has not read when it ends
/// the ranks.
void wait_until_line_is_read() {
  struct stat found {};
  if (fstat(STDERR_FILENO, &found) != 0 || !S_ISFIFO(found.st_mode)) return;
  const auto end = std::chrono::steady_clock::now() + kLineIsRead;
  for (int unread = 0; std::chrono::steady_clock::now() < end;) {
    if (ioctl(STDERR_FILENO, FIONREAD, &unread) != 0 || unread == 0) return;
    pollfd reader{STDERR_FILENO, 0, 0};
    if (::poll(&reader, 1, 1) > 0) return;  // it is there no more
  }
}

}  // namespace

struct MpiRanks::Sending {
  Bytes message;
  std::vector<MPI_Request> requests;
};

struct MpiRanks::Handles {
  MPI_Comm work = MPI_COMM_NULL;
  MPI_Comm errors = MPI_COMM_NULL;
  // Of the sum that has begun.
  MPI_Request sum = MPI_REQUEST_NULL;
  std::int64_t local = 0;
  std::int64_t all = 0;
};

MpiRanks::MpiRanks(int& argc, char**& argv) : handles_(std::make_unique<Handles>()) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED)
    throw Error(ExitCode::limit, "this MPI does not allow threads, expected MPI_THREAD_FUNNELED", "");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &on_this_machine_);
  MPI_Comm_free(&here);
  MPI_Comm_dup(MPI_COMM_WORLD, &handles_->work);
  MPI_Comm_dup(MPI_COMM_WORLD, &handles_->errors);
}

MpiRanks::~MpiRanks() = default;

void MpiRanks::send(int to, Bytes message) {
  forget_sent();
  sent_bytes_ += static_cast<std::int64_t>(message.size());
  Sending& sending = sending_.emplace_back(Sending{std::move(message), {}});
  for (std::size_t begin = 0;; begin += kMostBytes) {
    const std::size_t bytes = std::min(kMostBytes, sending.message.size() - begin);
    MPI_Isend(sending.message.data() + begin, static_cast<int>(bytes), MPI_BYTE, to, 0, handles_->work,
              &sending.requests.emplace_back());
    if (bytes < kMostBytes) break;
  }
}

Bytes MpiRanks::receive(int from) {
  Bytes message;
  for (;;) {
    int is_there = 0;
    MPI_Message found = MPI_MESSAGE_NULL;
    MPI_Status status;
    for (;;) {
      MPI_Improbe(from, 0, handles_->work, &is_there, &found, &status);
      if (is_there != 0) break;
      idle();
    }
    int bytes = 0;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    const std::size_t before = message.size();
    message.resize(before + static_cast<std::size_t>(bytes));
    MPI_Mrecv(message.data() + before, bytes, MPI_BYTE, &found, MPI_STATUS_IGNORE);
    if (static_cast<std::size_t>(bytes) < kMostBytes) break;
  }
  forget_sent();
  return message;
}

bool MpiRanks::has_message(int from) {
  poll();
  int is_there = 0;
  MPI_Iprobe(from, 0, handles_->work, &is_there, MPI_STATUS_IGNORE);
  return is_there != 0;
}

void MpiRanks::add(std::span<std::int64_t> values) {
  reduce(values, true);
}

void MpiRanks::take_greatest(std::span<std::int64_t> values) {
  reduce(values, false);
}

void MpiRanks::reduce(std::span<std::int64_t> values, bool is_sum) {
  const std::vector<std::int64_t> local(values.begin(), values.end());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(local.data(), values.data(), static_cast<int>(values.size()), MPI_INT64_T,
                 is_sum ? MPI_SUM : MPI_MAX, handles_->work, &request);
  wait(request);
}

void MpiRanks::begin_sum(std::int64_t value) {
  handles_->local = value;
  MPI_Iallreduce(&handles_->local, &handles_->all, 1, MPI_INT64_T, MPI_SUM, handles_->work, &handles_->sum);
}

std::int64_t MpiRanks::finish_sum() {
  wait(handles_->sum);
  return handles_->all;
}

template <class Request>
void MpiRanks::wait(Request& request) {
  for (int is_done = 0;;) {
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done != 0) return;
    idle();
  }
}

void MpiRanks::forget_sent() {
  std::erase_if(sending_, [](Sending& one) {
    int is_done = 0;
    MPI_Testall(static_cast<int>(one.requests.size()), one.requests.data(), &is_done, MPI_STATUSES_IGNORE);
    return is_done != 0;
  });
}

void MpiRanks::idle() {
  receive_errors();
  if (watch_) watch_();
  sched_yield();  // there may be more ranks than cores
}

void MpiRanks::poll() {
  receive_errors();
  forget_sent();
}

void MpiRanks::receive_errors() {
  if (rank_ != 0) return;
  int is_there = 0;
  MPI_Message found = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, handles_->errors, &is_there, &found, &status);
  if (is_there == 0) return;
  int bytes = 0;
  MPI_Get_count(&status, MPI_BYTE, &bytes);
  std::string what(static_cast<std::size_t>(bytes), ' ');
  MPI_Mrecv(what.data(), bytes, MPI_BYTE, &found, MPI_STATUS_IGNORE);
  throw Error(static_cast<ExitCode>(status.MPI_TAG), what, "");
}

void MpiRanks::finish() {
  while (!sending_.empty()) {
    forget_sent();
    idle();
  }
  static_cast<void>(sum(0));  // no error is being sent any more
  MPI_Comm_free(&handles_->work);
  MPI_Comm_free(&handles_->errors);
  MPI_Finalize();
}

void MpiRanks::end_all(int exit_code, const std::string& what, const std::function<void()>& say) {
  if (rank_ != 0) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(what.data(), static_cast<int>(what.size()), MPI_BYTE, 0, exit_code, handles_->errors, &request);
    const auto end = std::chrono::steady_clock::now() + kPatience;
    for (int is_done = 0; std::chrono::steady_clock::now() < end; sched_yield())
      MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    say();
  }
  wait_until_line_is_read();
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

}  // namespace coordreq
