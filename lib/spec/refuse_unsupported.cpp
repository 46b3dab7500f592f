#include <fmt/format.h>

#include <string>

#include "base/error.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

[[noreturn]] void refuse(std::string_view what, const std::string& pointer) {
  throw SpecError(fmt::format("{} is not supported yet", what), pointer);
}

void refuse_in_coordination(const CoordinationSpec& coordination) {
  const std::string pointer = "/coordination/";
  if (coordination.all_partitions) refuse("'all'", pointer + "partitions");
  if (coordination.horizon_time) refuse("'horizon_time'", pointer + "horizon_time");
  if (coordination.horizon) refuse("'horizon'", pointer + "horizon");
  if (!coordination.link_cost.empty()) refuse("'link_cost'", pointer + "link_cost");
  if (coordination.convention) refuse("'convention'", pointer + "convention");
}

}  // namespace

void refuse_unsupported(const ProblemSpec& spec) {
  refuse_in_coordination(spec.coordination);
  if (spec.network) refuse("'network'", "/network");
}

}  // namespace coordreq
