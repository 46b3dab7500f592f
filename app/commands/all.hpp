#pragma once

#include <functional>

#include "app/options.hpp"
#include "base/error.hpp"

// One file a command: its options, what it does, what it prints.
namespace coordreq {

/// Does the work of a command and prints the result; errors are thrown.
using Run = std::function<ExitCode()>;

/// Each declares the options of its command. The options live as long as what is returned.
Run declare_analyze(Options& options);
Run declare_validate(Options& options);
Run declare_info(Options& options);
Run declare_query(Options& options);
Run declare_simulate(Options& options);
Run declare_verify(Options& options);
Run declare_compare(Options& options);
Run declare_export(Options& options);
Run declare_report(Options& options);
Run declare_schema(Options& options);
Run declare_completion(Options& options);

struct CommandInfo {
  const char* name;
  const char* description;
  Run (*declare)(Options&);
};

/// In the order of the help.
inline constexpr CommandInfo kCommands[] = {
    {"analyze", "Run the whole analysis and write a results file, or one for each of several specs",
     declare_analyze},
    {"validate", "Check a spec; print sizes, which state depends on what, and a memory estimate",
     declare_validate},
    {"info", "Print what a results file holds", declare_info},
    {"query", "Tell everything that is known at a state: delay, countdown, allowed actions", declare_query},
    {"simulate", "Run the self-triggered closed loop on the system itself", declare_simulate},
    {"verify", "Check a results file by an independent method", declare_verify},
    {"compare", "Tell which cells have lost delay from one results file to another of the same grid",
     declare_compare},
    {"export", "Write the result in the format of another tool", declare_export},
    {"report", "Write one page for a browser: the answer, and pictures to look around in", declare_report},
    {"schema", "Print the JSON Schema of specs", declare_schema},
    {"completion", "Print what makes a shell complete commands, options and files", declare_completion},
};

}  // namespace coordreq
