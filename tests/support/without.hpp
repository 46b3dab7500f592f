#pragma once

#include "base/fast_paths.hpp"

namespace coordreq {

/// As long as it lives this path is not taken.
class Without {
 public:
  explicit Without(const FastPath& path) : path_(path) { fast_paths().*path_.is_on = false; }
  Without(const Without&) = delete;
  Without& operator=(const Without&) = delete;
  ~Without() { fast_paths().*path_.is_on = true; }

 private:
  const FastPath& path_;
};

}  // namespace coordreq
