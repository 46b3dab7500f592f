#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace coordreq {

/// The attributes of a results file, as stored; contract section 4.
struct StoredAttributes {
  std::string title, conventions, coordreq_version, git_sha1, spec_sha256, guarantee, period_unit;
  double period = 0;
  std::uint64_t safe_cells = 0, invariant_cells = 0;  ///< attributes `cells`
  std::int64_t iterations = 0;
  std::int64_t connection_delay = 0;
  std::string controller_sha256;  ///< of `controller.file`; empty if the spec has none
};

}  // namespace coordreq
