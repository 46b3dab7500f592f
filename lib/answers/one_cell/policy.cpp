#include "answers/one_cell/policy.hpp"

namespace coordreq {

std::vector<CellPolicy::Numbers> CellPolicy::alone(std::int64_t /*cell*/, std::int32_t /*countdown*/,
                                                   const Numbers& together,
                                                   const std::vector<InputClass>& classes) {
  std::vector<Numbers> actions;
  for (const InputClass& own : classes) actions.push_back(own.project(together));
  return actions;
}

}  // namespace coordreq
