#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace coordreq {

/// The value of the key that was requested last: while the key stays the same the value is made once, and
/// there is never more than one. Safe to ask from several threads at once; they wait for each other.
///
/// Why: arrays are written in segments, but lists of layers and tables written out are made as a whole, and
/// are large.
template <class Key, class Value>
class LastValueCache {
 public:
  /// @param make makes the value of the key
  template <class Make>
  [[nodiscard]] std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    const std::lock_guard lock(mutex_);
    if (value_ != nullptr && key == key_) return value_;
    value_ = nullptr;
    value_ = std::make_shared<const Value>(make());
    key_ = key;
    return value_;
  }

 private:
  std::mutex mutex_;
  Key key_{};
  std::shared_ptr<const Value> value_;
};

}  // namespace coordreq
