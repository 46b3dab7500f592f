#include "app/load_spec.hpp"

#include <iostream>

#include "spec/read_spec.hpp"

namespace coordreq {

ProblemSpec load_spec(const std::string& path) {
  return read_spec_file(path, std::cin);
}

}  // namespace coordreq
