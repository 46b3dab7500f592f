#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "spec/read_spec.hpp"

namespace coordreq::test {

/// A small valid spec that tests change.
inline nlohmann::json example() {
  return nlohmann::json::parse(R"({
    "coordreq": 1,
    "name": "circle",
    "constants": { "R": 0.8 },
    "definitions": { "r2": "x1^2 + x2^2" },
    "states": [ { "name": "x1", "lower": -1, "upper": 1, "step": 0.5 },
                { "name": "x2", "lower": -1, "upper": 1, "step": 0.5 } ],
    "inputs": [ { "name": "u1", "lower": -1, "upper": 1, "step": 1 },
                { "name": "u2", "values": [-1, 0, 1] } ],
    "disturbances": [ { "name": "w1", "lower": -1, "upper": 1 } ],
    "agents": [ { "name": "a", "inputs": ["u1"] }, { "name": "b", "inputs": ["u2"] } ],
    "dynamics": { "time": "continuous", "period": 1, "equations": { "x1": "u1 + w1", "x2": "u2" } },
    "safe": "r2 <= R^2"
  })");
}

/// The example with the value at a JSON pointer replaced or added.
/// @param value JSON text; "-" removes what is there
inline nlohmann::json example_with(const std::string& pointer, const std::string& value) {
  nlohmann::json spec = example();
  const nlohmann::json::json_pointer location(pointer);
  if (value != "-") {
    spec[location] = nlohmann::json::parse(value);
  } else if (spec.at(location.parent_pointer()).is_array()) {
    spec.at(location.parent_pointer()).erase(std::stoul(location.back()));
  } else {
    spec.at(location.parent_pointer()).erase(location.back());
  }
  return spec;
}

inline ProblemSpec read(const nlohmann::json& spec) {
  return read_spec(spec.dump(), "test.json");
}

/// The error that reading `text` gives, empty if it reads; an exception that is no Error fails the test.
inline std::string error_of_text(const std::string& text) {
  try {
    static_cast<void>(read_spec(text, "test.json"));
    return {};
  } catch (const Error& error) {
    EXPECT_TRUE(error.exit_code() == ExitCode::invalid_input || error.exit_code() == ExitCode::limit);
    return error.what();
  }
}

inline std::string error_of(const nlohmann::json& spec) {
  return error_of_text(spec.dump());
}

/// A change to the example and the line it must give.
struct ErrorCase {
  std::string pointer;
  std::string value;
  std::string what;
};

inline void expect_errors(const std::vector<ErrorCase>& cases) {
  for (const ErrorCase& one : cases) {
    EXPECT_EQ(error_of(example_with(one.pointer, one.value)), one.what) << one.pointer << " = " << one.value;
  }
}

}  // namespace coordreq::test
