#pragma once

#include <cstdint>
#include <vector>

#include "answers/checking/check_ground.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// What classes that do not coordinate can choose together, by definition.
class IndependentChoices {
 public:
  /// @param partition its classes, by agents
  IndependentChoices(const CheckGround& ground, const std::vector<std::vector<std::int32_t>>& partition);

  /// The joint inputs of which each class's part is that of some of `joint`, [joint input] 0 or 1.
  [[nodiscard]] std::vector<std::int64_t> of(const std::vector<std::uint8_t>& joint) const;

 private:
  std::vector<InputClass> classes_;
};

}  // namespace coordreq
