#pragma once

#include <array>
#include <functional>

#include "app/options.hpp"
#include "base/error.hpp"

// One file a command: its options, what it does, what it prints.
namespace coordreq {

/// Does the work of a command and prints the result; errors are thrown.
using Run = std::function<ExitCode()>;

/// Each declares the options of its command. The options live as long as what is returned.
Run declare_init(Options& options);
Run declare_analyze(Options& options);
Run declare_validate(Options& options);
Run declare_info(Options& options);
Run declare_query(Options& options);
Run declare_require(Options& options);
Run declare_explain(Options& options);
Run declare_simulate(Options& options);
Run declare_judge(Options& options);
Run declare_verify(Options& options);
Run declare_compare(Options& options);
Run declare_export(Options& options);
Run declare_report(Options& options);
Run declare_schema(Options& options);
Run declare_completion(Options& options);
Run declare_help(Options& options);

struct CommandInfo {
  const char* name;
  const char* description;
  std::function<Run(Options&)> declare;
  std::array<const char*, 2> examples;  ///< lines for a shell
};

/// In the order of the help.
inline const CommandInfo kCommands[] = {
    {"init",
     "Write a small, commented spec to start from",
     declare_init,
     {"coordreq init", "coordreq init platoon.json"}},
    {"analyze",
     "Run the whole analysis and write a results file, or one for each of several specs",
     declare_analyze,
     {"coordreq analyze circle.json", "coordreq analyze circle.json --sweep constants.R=0.8,0.6"}},
    {"validate",
     "Check a spec; print sizes, dependences of the states and a memory estimate",
     declare_validate,
     {"coordreq validate circle.json", "coordreq validate circle.json --set states.x1.step=0.005"}},
    {"info",
     "Print the content of a results file",
     declare_info,
     {"coordreq info circle.h5", "coordreq info circle.h5 --json"}},
    {"query",
     "Print the results for a state: delay, countdown, allowed actions",
     declare_query,
     {"coordreq query circle.h5 --at x1=0.1,x2=0", "coordreq query circle.h5 < states.csv"}},
    {"require",
     "Print the values of a state that tolerate a given silence, or the frontier of two states",
     declare_require,
     {"coordreq require crossing.h5 --delay 2s --over p1 --given v1=1,v2=1,p2=-8",
      "coordreq require crossing.h5 --delay 2 --over p1,p2 --given v1=1,v2=1 --best small --csv"}},
    {"explain",
     "Explain the delay of a state: the shortest path out of K, and changes that make it longer",
     declare_explain,
     {"coordreq explain circle.h5 --at x1=0.1,x2=0", "coordreq explain circle.h5 --at x1=0.1,x2=0 --json"}},
    {"simulate",
     "Simulate the self-triggered closed loop on the system itself",
     declare_simulate,
     {"coordreq simulate circle.h5 --from x1=0.1,x2=0 --steps 200",
      "coordreq simulate circle.h5 --start random --runs 100 --steps 200 -o runs.h5"}},
    {"judge",
     "Judge a log of states and inputs: does it fit the model, are agents reckless or silent for too long",
     declare_judge,
     {"coordreq judge circle.h5 log.csv", "coordreq judge circle.h5 --csv < log.csv > judged.csv"}},
    {"verify",
     "Check a results file by an independent method",
     declare_verify,
     {"coordreq verify circle.h5", "coordreq verify circle.h5 --sample 1000"}},
    {"compare",
     "Print the cells that have lost delay from one results file to another of the same grid",
     declare_compare,
     {"coordreq compare before.h5 after.h5", "coordreq compare before.h5 after.h5 --tolerance 2"}},
    {"export",
     "Write the result in the format of another tool",
     declare_export,
     {"coordreq export circle.h5 --format csv --slice x2=0",
      "coordreq export circle.h5 --format c-header -o circle.h"}},
    {"report",
     "Write one page for a browser: the answer, with interactive pictures",
     declare_report,
     {"coordreq report circle.h5", "coordreq report circle.h5 -o answer.html"}},
    {"schema",
     "Print the JSON Schema of specs",
     declare_schema,
     {"coordreq schema", "coordreq schema > schema.json"}},
    {"completion",
     "Print a script that makes a shell complete commands, options and files",
     declare_completion,
     {"source <(coordreq completion bash)",
      "coordreq completion fish > ~/.config/fish/completions/coordreq.fish"}},
    {"help",
     "Print the help of a command, or of the program",
     declare_help,
     {"coordreq help", "coordreq help analyze"}},
};

}  // namespace coordreq
