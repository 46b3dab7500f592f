#include "spec/past_operator.hpp"

namespace coordreq {

std::vector<std::uint32_t> PastOperator::variables() const {
  std::vector<std::uint32_t> all = first.variables();
  if (kind == Kind::since) {
    for (const std::uint32_t mentioned : second.variables()) all.push_back(mentioned);
  }
  if (kind != Kind::previous) all.push_back(slot);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace coordreq
