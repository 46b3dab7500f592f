#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace coordreq {

using Bytes = std::vector<std::byte>;

/// Processes that work on one problem together, and what they can send each other. Ranks are numbered from 0.
///
/// All of them run the same program, and call what is marked *together* in the same order. Called by one
/// thread of each at a time. Every function may throw what has ended the work elsewhere.
class Ranks {
 public:
  virtual ~Ranks() = default;

  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int count() const = 0;

  /// Sends a message; does not wait until it has arrived. Those from one rank to another arrive in the
  /// order in which they were sent.
  virtual void send(int to, Bytes message) = 0;
  /// Waits for the next message of a rank.
  [[nodiscard]] virtual Bytes receive(int from) = 0;

  /// Whether the next message of a rank has arrived.
  [[nodiscard]] virtual bool has_message(int from) = 0;

  /// Number of ranks on the machine of this one, itself included.
  [[nodiscard]] virtual int on_this_machine() const = 0;
  /// Bytes of all messages that this one has sent.
  [[nodiscard]] virtual std::int64_t sent_bytes() const = 0;

  /// Together: every value becomes the sum of that of all ranks, or the greatest.
  virtual void add(std::span<std::int64_t> values) = 0;
  virtual void take_greatest(std::span<std::int64_t> values) = 0;

  /// Together: a sum of which begin_sum() does not wait; finish_sum() returns it. One at a time, and add()
  /// may be called between both.
  virtual void begin_sum(std::int64_t value) = 0;
  [[nodiscard]] virtual std::int64_t finish_sum() = 0;

  /// Together: the sum of the values of all ranks.
  [[nodiscard]] std::int64_t sum(std::int64_t value) {
    add({&value, 1});
    return value;
  }
  [[nodiscard]] std::int64_t greatest(std::int64_t value) {
    take_greatest({&value, 1});
    return value;
  }
  /// Together: the message of rank 0.
  [[nodiscard]] Bytes from_first(Bytes message);
};

/// Puts numbers into a message and takes them out again in the same order.
template <class Number>
void put_numbers(Bytes& message, std::span<const Number> numbers) {
  const auto bytes = std::as_bytes(numbers);
  message.insert(message.end(), bytes.begin(), bytes.end());
}

/// Reads a message from its beginning. @throws std::out_of_range if it is shorter than what is requested
class MessageReader {
 public:
  explicit MessageReader(const Bytes& message) : rest_(message) {}

  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }
  [[nodiscard]] std::span<const std::byte> take(std::size_t bytes);
  [[nodiscard]] std::int64_t number();
  [[nodiscard]] std::vector<std::int64_t> numbers();  ///< what is left

 private:
  std::span<const std::byte> rest_;
};

}  // namespace coordreq
