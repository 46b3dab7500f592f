#include "support/read_system.hpp"

#include <utility>

#include "spec/read_spec.hpp"

namespace coordreq {

SystemSpec read_system(std::string text, std::string_view source) {
  return read_spec(std::move(text), source);
}

}  // namespace coordreq
