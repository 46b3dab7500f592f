#pragma once

#include <cstring>
#include <vector>

#include "answers/field.hpp"

namespace coordreq {

/// An array whose elements lie in memory; `values` must outlive it, and hold them in the type's width.
template <typename Value>
[[nodiscard]] ResultArray array_of(ElementType type, const std::vector<Value>& values) {
  return {type, [&values](std::uint64_t begin, std::uint64_t count, void* out) {
            std::memcpy(out, values.data() + begin, count * sizeof(Value));
          }};
}

}  // namespace coordreq
