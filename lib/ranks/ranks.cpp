#include "ranks/ranks.hpp"

#include <cstring>
#include <stdexcept>
#include <utility>

namespace coordreq {

Bytes Ranks::from_first(Bytes message) {
  // Down a tree: rank r has it from the one without its last bit.
  int step = 1;
  while (step < count() && (rank() & step) == 0) step *= 2;
  if (rank() != 0) message = receive(rank() - step);
  for (step /= 2; step > 0; step /= 2) {
    if (rank() + step < count()) send(rank() + step, message);
  }
  return message;
}

std::span<const std::byte> MessageReader::take(std::size_t bytes) {
  if (bytes > rest_.size()) throw std::out_of_range("a message is too short");
  const std::span<const std::byte> result = rest_.first(bytes);
  rest_ = rest_.subspan(bytes);
  return result;
}

std::int64_t MessageReader::number() {
  std::int64_t result = 0;
  std::memcpy(&result, take(sizeof(result)).data(), sizeof(result));
  return result;
}

std::vector<std::int64_t> MessageReader::numbers() {
  std::vector<std::int64_t> result(rest_.size() / sizeof(std::int64_t));
  if (!result.empty()) std::memcpy(result.data(), rest_.data(), result.size() * sizeof(std::int64_t));
  rest_ = {};
  return result;
}

}  // namespace coordreq
