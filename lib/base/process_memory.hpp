#pragma once

#include <cstdint>
#include <optional>
#include <string>

// The memory of this process and its limit, which is kept twice: code that begins large work asks first
// whether there is room for it, and is refused at once if there is none (expect_memory()); and because that
// is an estimate, the system refuses memory beyond the limit (hold_to_memory()).
namespace coordreq {

/// Processors that this process may use, at least 1: those of its affinity, and no more than the quota of its
/// control group and of those around it, rounded up (versions 1 and 2).
[[nodiscard]] int usable_processors();
/// The quota of the control groups that `groups`, the text of /proc/self/cgroup, names, and of those around
/// them, in processors; infinite if there is none. @param root where the control groups are mounted,
/// /sys/fs/cgroup
[[nodiscard]] double processor_quota(const std::string& groups, const std::string& root);

/// Lets all threads share a few heaps, from now on. Else each takes memory from a heap of its own, and what
/// one gives back the others cannot use: three vehicles took a third to a half more with sixteen threads than
/// with two. Without effect where the system cannot do that.
void share_heaps();
/// Gives memory of the heaps that is not in use back to the system, wherever it lies. Without effect where
/// the system cannot do that.
void give_back_memory();

/// Memory that this process holds now, with the pages of the program and its libraries that any work still
/// brings into memory, in bytes.
[[nodiscard]] double memory_of_program();
/// The number of threads that `threads` stands for. @param threads 0: all usable processors
[[nodiscard]] int all_threads(int threads);
/// Memory of `threads` threads before they do any work, in bytes; the first thread is there already.
/// @param threads 0: all usable processors
[[nodiscard]] double memory_of_threads(int threads);

/// 1536 -> "1.5 KiB", as errors print memory.
[[nodiscard]] std::string byte_text(double bytes);

/// @param subject with its verb: "25 cells need" @param needed bytes, of the whole process
/// @param by_whom "on the fullest of 8 ranks, ", or nothing
/// @throws LimitError "25 cells need about 30.0 MiB of memory, the limit is 20.0 MiB (--max-memory)" if that
///   is more than the limit
void check_memory_need(const std::string& subject, double needed, double limit,
                       const std::string& by_whom = "");
/// check_memory_need() for `more` bytes beyond memory_of_program(). @param limit none: nothing is refused
void expect_memory(const std::string& subject, double more, std::optional<std::uint64_t> limit);

/// The memory that some work takes beyond memory_of_program(), in bytes.
struct MemoryDemand {
  double once = 0;
  double of_thread = 0;  ///< more, for each thread
};
/// The number of threads that there is memory for, at most `threads`. @param threads 0: all usable processors
/// @throws LimitError if there is no room for one, as check_memory_need()
[[nodiscard]] int threads_within(const std::string& subject, const MemoryDemand& demand, int threads,
                                 std::optional<std::uint64_t> limit);

/// From now on the system refuses this process memory beyond `bytes` and a tenth: std::bad_alloc is thrown
/// then. A little more than the process holds already is always granted, so that it can report the error.
/// Stacks of a ThreadTeam are not counted. Without effect under a sanitiser.
void hold_to_memory(std::uint64_t bytes);
/// Whether it is held to a limit.
[[nodiscard]] bool is_held_to_memory();

/// While it lives the process is not held to its limit, so that address space can be set aside that is hardly
/// touched, or given back; then the limit has moved by as much as there is more of it, or less.
/// @pre unchecked: no other thread takes memory meanwhile.
class LimitMove {
 public:
  LimitMove();
  ~LimitMove();
  LimitMove(const LimitMove&) = delete;
  LimitMove& operator=(const LimitMove&) = delete;

 private:
  std::optional<std::uint64_t> limit_;  ///< none: it is not held
  std::int64_t untouched_ = 0;
};

}  // namespace coordreq
