#include "answers/one_cell/policy.hpp"

namespace coordreq {

std::vector<CellPolicy::Numbers> CellPolicy::alone(std::int64_t /*cell*/, std::int32_t /*countdown*/,
                                                   const Numbers& together,
                                                   const std::vector<InputClass>& classes) {
  std::vector<Numbers> actions;
  for (const InputClass& input_class : classes) actions.push_back(input_class.project(together));
  return actions;
}

}  // namespace coordreq
