// Logs, and lists of states: CSV or JSON lines.
#include <sstream>

#include "cell/log_reader.hpp"
#include "fuzz/target.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  static const ProblemSpec spec = read_spec(std::string(test::small_spec()), "small");
  std::istringstream stream(test::text_of(data, size));
  test::answers([&] {
    LogReader log(stream, spec, "log");
    while (log.next()) static_cast<void>(log.unknown_names());
  });
  return 0;
}
