#include "results/child_trial.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <new>

#include "base/error.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

class ChildTrial : public testing::Test {
 protected:
  ChildTrial() { sample::write_bytes(path_, "x"); }

  /// The text of what is thrown; empty if nothing is.
  template <class Thrown>
  std::string thrown(const std::function<void()>& read) {
    try {
      try_in_child(path_, read);
    } catch (const Thrown& error) {
      return error.what();
    }
    return "";
  }

  sample::ScratchFolder folder_;
  std::string path_ = folder_ / "file";
};

TEST_F(ChildTrial, WhatItThrowsIsThrownHere) {
  EXPECT_EQ(thrown<ResultsError>([] { throw ResultsError("broken", "there"); }), "broken (there)");
  EXPECT_EQ(thrown<IoError>([] { throw IoError("gone", "there"); }), "gone (there)");
  EXPECT_EQ(thrown<Error>([] { throw LimitError("large", "there"); }), "large (there)");
  EXPECT_THROW(try_in_child(path_, [] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_NO_THROW(try_in_child(path_, [] {}));
}

TEST_F(ChildTrial, ACrashIsADamagedFile) {
  const std::string damaged = "damaged results file: the HDF5 library cannot read it (" + path_ + ")";
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS})
    EXPECT_EQ(thrown<ResultsError>([signal] { static_cast<void>(std::raise(signal)); }), damaged);
  EXPECT_EQ(thrown<ResultsError>([] { _exit(0); }), damaged);
}

/// The system ends who takes too much memory that way: the file need not be damaged.
TEST_F(ChildTrial, AnEndBySigkillIsWantOfMemory) {
  EXPECT_THROW(try_in_child(path_, [] { static_cast<void>(std::raise(SIGKILL)); }), std::bad_alloc);
}

/// A name in a file that leads to a pipe would be waited for without an end, at no cost of the processor.
TEST_F(ChildTrial, NothingIsOpenedBesideTheFile) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto read = [&] {
    const int file = open(path_.c_str(), O_RDONLY);
    if (file < 0) throw IoError("the file cannot be opened");
    if (open(pipe.c_str(), O_RDONLY) >= 0 || errno != EMFILE) return;
    close(file);
    throw ResultsError("one file at a time");
  };
  EXPECT_EQ(thrown<ResultsError>(read), "one file at a time");
}

/// Not by a clock: here the limit of the process is lower than that in proportion to the file.
TEST_F(ChildTrial, WorkWithoutAnEndIsEnded) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_CPU, &before), 0);
  rusage used{};
  ASSERT_EQ(getrusage(RUSAGE_SELF, &used), 0);
  rlimit lower = before;
  lower.rlim_cur = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 2;
  ASSERT_EQ(setrlimit(RLIMIT_CPU, &lower), 0);
  EXPECT_EQ(thrown<LimitError>([] {
              for (std::atomic<int> i = 0;;) ++i;
            }),
            "reading takes more time of the processor than a process may have here (" + path_ + ")");
  ASSERT_EQ(setrlimit(RLIMIT_CPU, &before), 0);
}

TEST_F(ChildTrial, WithoutAChildNothingIsRead) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit none = before;
  none.rlim_cur = 0;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  bool is_read = false;
  const std::string message = thrown<IoError>([&is_read] { is_read = true; });
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(message,
            "cannot be tried in a process of its own, as a damaged file must be: Too many open files (" +
                path_ + ")");
  EXPECT_FALSE(is_read);
}

}  // namespace
}  // namespace coordreq
