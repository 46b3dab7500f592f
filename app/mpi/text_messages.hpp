#pragma once

#include <span>
#include <string>

#include "ranks/ranks.hpp"

// Texts as messages between ranks.
namespace coordreq {

[[nodiscard]] inline Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

[[nodiscard]] inline std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace coordreq
