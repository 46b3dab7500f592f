// analyze_and_ask SPEC RESULTS STATE: analyses a spec, writes the results file, and says for how long the
// agents may be silent from a state such as x1=0.1,x2=0.
#include <coordreq/analysis/analyze.hpp>
#include <coordreq/base/error.hpp>
#include <coordreq/cell/state_query.hpp>
#include <coordreq/cell/state_text.hpp>
#include <coordreq/spec/read_spec.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "answers/step_codes.hpp"

namespace {

void analyze(const coordreq::ProblemSpec& spec, const std::string& results) {
  coordreq::ThreadTeam team;
  const coordreq::Json summary = coordreq::analyze(spec, {.output = results}, team);
  std::cout << "invariance set: " << summary["invariant"] << " of " << summary["states"] << " cells\n";
}

void ask(const std::string& path, const std::string& state) {
  const coordreq::ResultsReader results(path);
  std::vector<std::string> names;
  for (const coordreq::GridDimension& dimension : results.grid().dimensions())
    names.push_back(dimension.name);

  coordreq::ThreadTeam team;
  coordreq::StateQuery query(results, team);
  const coordreq::StateAnswer answer = query.at(coordreq::parse_state(state, names, "STATE"));
  if (answer.location.kind != coordreq::Location::Kind::cell || answer.value("/invariant") == 0) {
    std::cout << state << ": not in the invariance set\n";
    return;
  }
  for (std::size_t p = 0; p < results.partitions().size(); ++p) {
    const std::int32_t delay = answer.value("/delay", p);
    std::cout << state << ", " << results.partitions()[p].name << ": ";
    if (delay == coordreq::kUnbounded) {
      std::cout << "any number of steps of silence\n";
    } else {
      std::cout << delay << " steps of silence\n";
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: analyze_and_ask SPEC RESULTS STATE\n";
    return 2;
  }
  try {
    const coordreq::ProblemSpec spec = coordreq::read_spec_file(argv[1], std::cin);
    analyze(spec, argv[2]);
    ask(argv[2], argv[3]);
    return 0;
  } catch (const coordreq::Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.exit_code());
  }
}
