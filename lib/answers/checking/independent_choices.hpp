#pragma once

#include <cstdint>
#include <vector>

#include "answers/checking/check_context.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// The joint inputs that classes which do not coordinate can choose, by definition.
class IndependentChoices {
 public:
  /// @param partition its classes, by agents
  IndependentChoices(const CheckContext& context, const std::vector<std::vector<std::int32_t>>& partition);

  /// The joint inputs in which the action of each class occurs in some joint input of `joint`, [joint input]
  /// 0 or 1.
  [[nodiscard]] std::vector<std::int64_t> of(const std::vector<std::uint8_t>& joint) const;

 private:
  std::vector<InputClass> classes_;
};

}  // namespace coordreq
