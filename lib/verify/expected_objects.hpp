#pragma once

#include <string>
#include <vector>

#include "results/stored_object.hpp"
#include "spec/problem_spec.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// What is stored in a results file on request.
struct StoredExtras {
  bool controller = false;
  bool abstraction = false;
  bool convention = false;    ///< what agents may do by it
  std::vector<bool> actions;  ///< by partition
  std::vector<bool> layers;   ///< by partition
  struct Path {
    bool samples = false;
    bool steps = false;
  };
  std::vector<Path> paths;  ///< counterexamples by requirement
};

/// The attributes and axes that a results file of this spec has to have (contract, section 4), but for free
/// text, provenance and what counts cells or sweeps, which check_summary() looks after.
[[nodiscard]] std::vector<StoredObject> expected_objects(const ProblemSpec& spec, const StoredExtras& extras);

/// Compares what is there with what is expected; more attributes than those are no harm.
[[nodiscard]] Finding check_objects(const std::vector<StoredObject>& expected,
                                    const std::vector<StoredObject>& found);

}  // namespace coordreq
