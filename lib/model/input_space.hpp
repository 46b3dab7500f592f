#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The joint inputs: the product of the values of each input, numbered row-major, the last input fastest.
class InputSpace {
 public:
  struct Dimension {
    std::string name;
    std::vector<Rational> values;
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(values.size()); }
  };

  explicit InputSpace(std::vector<Dimension> dimensions);

  [[nodiscard]] std::size_t size() const { return dimensions_.size(); }
  [[nodiscard]] const Dimension& operator[](std::size_t i) const { return dimensions_[i]; }
  /// Number of joint inputs.
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// Position of the value of input i in joint input u.
  [[nodiscard]] std::int64_t index(std::int64_t u, std::size_t i) const {
    return u / strides_[i] % dimensions_[i].count();
  }
  [[nodiscard]] std::int64_t stride(std::size_t i) const { return strides_[i]; }

 private:
  std::vector<Dimension> dimensions_;
  std::vector<std::int64_t> strides_;
  std::int64_t count_ = 1;
};

[[nodiscard]] InputSpace make_input_space(const SystemSpec& spec);

}  // namespace coordreq
