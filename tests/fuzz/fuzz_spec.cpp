// Specs: JSON, schema, names, expressions, limits.
#include "fuzz/target.hpp"
#include "spec/read_spec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  test::answers([&] { (void)read_spec(test::text_of(data, size), "input"); });
  return 0;
}
