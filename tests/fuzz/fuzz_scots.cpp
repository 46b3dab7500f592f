// Static controllers of SCOTS.
#include "fuzz/target.hpp"
#include "results/controller_file.hpp"
#include "spec/read_spec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  static const ProblemSpec spec = read_spec(std::string(test::small_spec()), "small");
  const test::InputFile file(data, size);
  test::answers([&] { (void)read_scots_controller(file.path(), spec); });
  return 0;
}
