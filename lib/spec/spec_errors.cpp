#include "spec/spec_errors.hpp"

#include <utility>

#include "base/requires.hpp"

namespace coordreq {

SpecErrors::SpecErrors(std::vector<std::string> lines) : SpecError(lines.front()), lines_(std::move(lines)) {
  REQUIRES(lines_.size() >= 2);
}

void ErrorList::raise() const {
  if (lines_.size() == 1) throw SpecError(lines_.front());
  if (!lines_.empty()) throw SpecErrors(lines_);
}

}  // namespace coordreq
