// Expressions: grammar, types, exact constants, doubles at a point.
#include <functional>

#include "expression/program.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  const std::string text = test::text_of(data, size);
  const Lookup lookup = [](std::string_view name) -> Binding {
    if (name == "x") return std::uint32_t{0};
    if (name == "c") return Rational(3);
    return NotDefined{};
  };
  test::answers([&] {
    const Program program = link(text, lookup, ExpectedType::any, "/safe");
    if (!program.is_condition() && program.variables().empty()) (void)constant_value(program, "/safe");
  });
  test::answers([&] { (void)mentioned_names(text, "/safe"); });
  return 0;
}
