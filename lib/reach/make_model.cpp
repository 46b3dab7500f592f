#include "reach/build_abstraction.hpp"

#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

Model make_model(const ProblemSpec& spec) {
  return {spec, table_shapes(spec)};
}

}  // namespace coordreq
