#include "model/input_space.hpp"

#include <utility>

#include "spec/system_spec.hpp"

namespace coordreq {

InputSpace::InputSpace(std::vector<Dimension> dimensions)
    : dimensions_(std::move(dimensions)), strides_(dimensions_.size()) {
  for (std::size_t i = dimensions_.size(); i-- > 0;) {
    strides_[i] = count_;
    count_ *= dimensions_[i].count();
  }
}

InputSpace make_input_space(const SystemSpec& spec) {
  std::vector<InputSpace::Dimension> dimensions;
  for (const InputSpec& input : spec.inputs) dimensions.push_back({input.name, input.values});
  return InputSpace(std::move(dimensions));
}

}  // namespace coordreq
