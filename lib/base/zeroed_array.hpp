#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace coordreq {

/// A fixed number of elements, all zero at first. What of a large one is never touched takes no memory: the
/// system gives it page by page.
template <class Element>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<Element>);

 public:
  ZeroedArray() = default;
  /// @throws std::bad_alloc
  explicit ZeroedArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    elements_.reset(static_cast<Element*>(std::calloc(size, sizeof(Element))));
    if (elements_ == nullptr) throw std::bad_alloc();
  }
  ZeroedArray(const ZeroedArray& other) : ZeroedArray(other.size_) {
    std::copy(other.begin(), other.end(), begin());
  }
  ZeroedArray(ZeroedArray&& other) noexcept
      : size_(std::exchange(other.size_, 0)), elements_(std::move(other.elements_)) {}
  ZeroedArray& operator=(ZeroedArray other) noexcept {
    std::swap(size_, other.size_);
    std::swap(elements_, other.elements_);
    return *this;
  }
  ~ZeroedArray() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Element* data() { return elements_.get(); }
  [[nodiscard]] const Element* data() const { return elements_.get(); }
  [[nodiscard]] Element& operator[](std::size_t i) { return elements_.get()[i]; }
  [[nodiscard]] const Element& operator[](std::size_t i) const { return elements_.get()[i]; }
  [[nodiscard]] Element* begin() { return data(); }
  [[nodiscard]] Element* end() { return data() + size_; }
  [[nodiscard]] const Element* begin() const { return data(); }
  [[nodiscard]] const Element* end() const { return data() + size_; }
  [[nodiscard]] bool operator==(const ZeroedArray& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

 private:
  struct Free {
    void operator()(Element* elements) const { std::free(elements); }
  };
  std::size_t size_ = 0;
  std::unique_ptr<Element, Free> elements_;
};

}  // namespace coordreq
