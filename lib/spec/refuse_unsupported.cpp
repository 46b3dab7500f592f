#include <fmt/format.h>

#include <string>

#include "base/error.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

[[noreturn]] void refuse(std::string_view what, const std::string& pointer) {
  throw SpecError(fmt::format("{} is not supported yet", what), pointer);
}

}  // namespace

void refuse_unsupported(const ProblemSpec& spec) {
  if (!spec.requirements.empty()) refuse("'requirements'", "/requirements");
}

}  // namespace coordreq
