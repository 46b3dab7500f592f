// What stands on a command line: values to set and to sweep over, states, slices. The first byte chooses.
#include <vector>

#include "app/sweep.hpp"
#include "cell/state_text.hpp"
#include "export/cell_table.hpp"
#include "fuzz/target.hpp"
#include "model/uniform_grid.hpp"
#include "spec/read_spec.hpp"
#include "spec/set_value.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  if (size == 0) return 0;
  static const std::string spec_text(test::small_spec());
  static const UniformGrid grid = make_grid(read_spec(spec_text, "small"));
  const std::string text = test::text_of(data + 1, size - 1);
  test::answers([&] {
    switch (data[0] % 4) {
      case 0:
        (void)read_spec(with_setting(spec_text, "small", parse_setting(text, "--set")), "small");
        break;
      case 1:
        for (const std::vector<SpecSetting>& settings : combinations({parse_sweep(text, "--sweep")})) {
          std::string spec = spec_text;
          for (const SpecSetting& setting : settings) spec = with_setting(spec, "small", setting);
        }
        break;
      case 2:
        (void)parse_state(text, {"x1", "x2"}, "--at");
        break;
      default:
        (void)parse_selection({text}, {}, grid);
        (void)parse_selection({}, {text}, grid);
    }
  });
  return 0;
}
