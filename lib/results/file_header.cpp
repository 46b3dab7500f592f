#include "results/write_results.hpp"

#include "answers/invariance/answer.hpp"
#include "results/sha256.hpp"
#include "results/version.hpp"
#include "spec/problem_spec.hpp"
#include "spec/units.hpp"

namespace coordreq {

std::vector<FieldAttribute> header_attributes(const ProblemSpec& spec) {
  const std::string& unit = spec.dynamics.unit;
  return {{"coordreq_version", std::string(program_version()), true},
          {"git_sha1", std::string(program_git_sha1()), true},
          {"title", spec.name},
          {"Conventions", std::string("CF-1.10")},
          {"spec_sha256", sha256_hex(spec.text)},
          {"period", nearest_double(spec.dynamics.period)},
          {"period_unit", unit.empty() ? std::string() : udunits_spelling(unit)},
          {"guarantee", guarantee_of(spec)}};
}

}  // namespace coordreq
