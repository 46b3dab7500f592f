#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "base/fast_paths.hpp"

namespace coordreq {

/// What is asked for by a key, made when another one was asked for before: there is never more than one,
/// however many there are in turn. May be asked by several threads at once.
template <class Key, class Value>
class Latest {
 public:
  /// @param make gives the value if it is not there
  template <class Make>
  [[nodiscard]] std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    const std::lock_guard lock(mutex_);
    if (keeps_ && value_ != nullptr && key == key_) return value_;
    value_ = nullptr;
    value_ = std::make_shared<const Value>(make());
    key_ = key;
    return value_;
  }

 private:
  const bool keeps_ = fast_paths().last_values;
  std::mutex mutex_;
  Key key_{};
  std::shared_ptr<const Value> value_;
};

}  // namespace coordreq
