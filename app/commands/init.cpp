#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/atomic_file.hpp"
#include "app/commands/all.hpp"
#include "app/file_beside_program.hpp"
#include "app/print.hpp"
#include "app/render.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// What is marked with //? is optional: without the mark it is part of the spec.
constexpr std::string_view kTemplate =
    R"json(// Two robots on one rail must stay 1 m apart. How long may they be silent?
//
//   coordreq validate FILE    checks the spec and prints sizes
//   coordreq analyze FILE     computes the answer and writes NAME.h5
//
// Change it into your own system, one part at a time. A line that begins with //? is an optional part: remove the
// mark to use it.
{
  SCHEMA"coordreq": 1,
  "name": "NAME",
  "description": "Two robots on one rail stay at least 1 m apart.",

  // Named numbers, for use in numbers and formulas.
  "constants": { "gap": 1, "fastest": 1 },

  // The states on which safety depends, each with its own grid. A smaller step gives a sharper answer and takes
  // longer. "outside" gives the meaning of leaving the grid: here the robots stop at the ends of the rail.
  "states": [
    { "name": "p1", "lower": 0, "upper": 20, "step": 0.25, "unit": "m", "outside": "saturate" },
    { "name": "p2", "lower": 0, "upper": 20, "step": 0.25, "unit": "m", "outside": "saturate" }
  ],

  // The values that the agents choose in each period.
  "inputs": [
    { "name": "v1", "lower": "-fastest", "upper": "fastest", "step": "fastest/2", "unit": "m/s" },
    { "name": "v2", "lower": "-fastest", "upper": "fastest", "step": "fastest/2", "unit": "m/s" }
  ],

  // Unknown quantities, which may take any value between the bounds at any time. Use them in the equations.
  //? "disturbances": [ { "name": "wind", "lower": -0.1, "upper": 0.1 } ],

  // The agents and their inputs. While connected, the agents choose together; otherwise each chooses alone.
  "agents": [
    { "name": "left", "inputs": ["v1"] },
    { "name": "right", "inputs": ["v2"] }
  ],

  // The motion of the states: derivatives, or with "time": "discrete" the next values.
  "dynamics": {
    "time": "continuous",
    "period": 0.5, "unit": "s",
    "equations": { "p1": "v1", "p2": "v2" }
  },

  // The safe states.
  "safe": "p2 - p1 >= gap",

  // Cells without their upper faces: sharper than the default "closed" if motions end on faces of cells.
  // Safety at all times, not only at the sampling instants.
  "abstraction": { "cells": "half_open", "between_samples": true },

  // A connection that takes two steps to establish:
  //? "coordination": { "connection_delay": 2 },

  // A radio that loses at most one of any three messages, and agents that restrict their actions because of it:
  //? "network": { "weakly_hard": { "misses": 1, "window": 3 }, "resynthesise": true },

  // Your requirements. If one does not hold, the answer has a counterexample, and the exit code is 1.
  "requirements": [
    { "name": "2 s of silence, 8 m apart", "where": "p2 - p1 == 8", "min_delay_time": 2 }
  ]
}
)json";

struct InitOptions : CommonOptions {
  std::string file = "spec.json";
};

void replace(std::string& text, std::string_view mark, std::string_view with) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + with.size()))
    text.replace(at, mark.size(), with);
}

/// The name of a spec in this file: that of the file without the ending, as far as names of specs go.
std::string spec_name(const std::string& file) {
  std::string name = file == "-" ? "spec" : std::filesystem::path(file).stem().string();
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c) && c != '.' && c != '-'; }, '_');
  return name.empty() || !is_plain(name.front()) ? "spec" + name : name;
}

std::string spec_text(const std::string& file) {
  std::string text(kTemplate);
  const std::optional<std::string> schema =
      file_beside_program("share/coordreq/schema.json", "lib/spec/schema.json");
  const bool is_plain = schema && schema->find_first_of("\"\\%# ") == std::string::npos;
  replace(text, "SCHEMA", is_plain ? fmt::format("\"$schema\": \"file://{}\",\n  ", *schema) : "");
  replace(text, "NAME", spec_name(file));
  replace(text, "FILE",
          file == "-" ? "spec.json" : printable(std::filesystem::path(file).filename().string()));
  return text;
}

void write_new(const std::string& path, const std::string& text) {
  if (std::filesystem::exists(std::filesystem::symlink_status(path)))
    throw UsageError("the file is there already, expected the name of a new one", path);
  AtomicFile file(path, "the spec");
  file.write(text);
  file.commit();
}

std::string next_text(const Json& answer) {
  const std::string name = line_of(answer["output"]);
  return fmt::format("{0} is written. Next:\n  coordreq validate {0}\n  coordreq analyze {0}\n", name);
}

}  // namespace

Run declare_init(Options& options) {
  const auto args = std::make_shared<InitOptions>();
  options.optional_argument(args->file, "FILE",
                            "The new spec (default: spec.json); - writes to standard output");
  declare_common(options, *args, {.threads = false, .memory = false});
  return [args] {
    const std::string text = spec_text(args->file);
    if (args->file == "-") {
      write_output(text);
      return ExitCode::success;
    }
    write_new(args->file, text);
    print_answer(*args, Json{{"output", args->file}}, next_text);
    return ExitCode::success;
  };
}

}  // namespace coordreq
