#include "spec/spec_errors.hpp"

#include <utility>

namespace coordreq {

SpecErrors::SpecErrors(std::vector<std::string> lines) : SpecError(lines.front()), lines_(std::move(lines)) {}

void ErrorList::raise() const {
  if (lines_.size() == 1) throw SpecError(lines_.front());
  if (!lines_.empty()) throw SpecErrors(lines_);
}

}  // namespace coordreq
