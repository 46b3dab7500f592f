#pragma once

#include <string_view>

namespace coordreq::test {

/// Every key of the contract that can stand beside the others.
inline constexpr std::string_view kMaximalSpec = R"jsonc({
  "$schema": "coordreq.schema.json",
  "coordreq": 1,                                   // the format
  "name": "circle",
  "description": "free text",
  "constants": { "R": 0.8 },
  "definitions": { "r2": "x1^2 + x2^2" },
  "states": [ { "name": "x1", "lower": -1, "upper": 1, "step": 0.01, "origin": 0, "unit": "m",
                "discrete": false, "measurement_error": 0.5, "outside": "unsafe" },
              { "name": "x2", "lower": 0, "upper": "R", "step": "R/4", "unit": "", "discrete": true,
                "measurement_error": 0, "outside": {"below": "saturate", "above": "safe"} },
              { "name": "x3", "lower": 0, "upper": 1, "count": 3, "outside": "stop" },
              { "name": "heading", "lower": "-pi", "upper": "pi", "count": 72, "outside": "periodic" } ],
  "inputs": [ { "name": "u1", "lower": -1, "upper": 1, "step": 0.5, "origin": 0.25, "unit": "m/s" },
              { "name": "u2", "values": [1, -1, "R"] },
              { "name": "u3", "lower": 0, "upper": 1, "count": 3 } ],
  "disturbances": [ { "name": "w1", "lower": -0.01, "upper": 0.01, "unit": "N" } ],
  "agents": [ { "name": "horizontal", "inputs": ["u3", "u1"], "prefer": "(x1 - 0.5)^2 + u2" },
              { "name": "vertical", "inputs": ["u2"], "sees": ["heading", "x2"] } ],
  "dynamics": { "time": "continuous", "period": 0.01, "unit": "s",
                "equations": { "x1": "u1", "x2": "u2", "x3": "w1", "heading": "x1*u3" } },
  "safe": "r2 <= R^2",
  "abstraction": { "cells": "half_open", "safe": "center", "between_samples": true },
  "controller": { "synthesis": "given", "allow": "x1 + u1 < 2", "file": "other.h5" },
  "coordination": {
    "partitions": [ { "name": "alone", "classes": [["vertical"], ["horizontal"]] },
                    { "classes": [["vertical", "horizontal"]] } ],
    "max_delay": 100,
    "connection_delay": 2,
    "horizon": 10,
    "link_cost": [ { "agents": ["vertical", "horizontal"], "cost": 2 } ],
    "convention": true },
  "network": {
    "modes": [ { "name": "up", "partition": "horizontal+vertical" }, { "name": "down", "partition": "alone" } ],
    "transitions": [ ["up", "up"], ["up", "down"], ["down", "up"] ],
    "resynthesise": true },
  "silence": { "actions": { "vertical": "u2 <= heading" }, "then": { "vertical": "true", "horizontal": "u1 <= x1 and u3 == 0" } },
  "requirements": [ { "name": "near the middle", "where": "r2 <= 0.01", "partition": "alone", "min_delay": 20 },
                    { "name": "in time", "where": "x1 > 0", "partition": "vertical+horizontal",
                      "min_delay_time": 0.205 },
                    { "name": "start is safe", "where": "r2 <= 0.25", "invariant": true } ],
  "output": { "controller": true, "actions": true, "layers": true, "abstraction": true }
})jsonc";

}  // namespace coordreq::test
