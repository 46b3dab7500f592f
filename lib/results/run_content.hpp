#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/field.hpp"

namespace coordreq {

/// What goes into a file of simulated runs, as plain data. R runs, N steps, N + 1 samples each; what a run
/// that ended early does not have is filled with the values named below.
struct RunContent {
  static constexpr std::int32_t kNoSample = -4;  ///< of countdowns and delays; NaN for floating point
  static constexpr std::uint8_t kNoStep = 255;   ///< of `coordinated`

  struct Component {
    std::string name;
    std::string unit;  ///< empty if none
  };
  std::string name;  ///< of the spec; attribute `title`
  std::string spec_text;
  std::string guarantee;
  double period = 0;
  std::string period_unit;
  std::string partition;
  std::int64_t connection_delay = 0;
  std::string policy, disturbance_policy;
  std::uint64_t seed = 0;

  std::vector<Component> states, inputs, disturbances;
  std::vector<double> time;  ///< of each sample
  std::uint64_t runs = 0;
  ResultArray state;                       ///< float64 [R, N + 1, states]
  std::optional<ResultArray> measured;     ///< likewise
  ResultArray input;                       ///< float64 [R, N + 1, inputs]
  std::optional<ResultArray> disturbance;  ///< float64 [R, N + 1, disturbances]
  ResultArray countdown, delay;            ///< int32 [R, N + 1]
  ResultArray coordinated;                 ///< uint8 [R, N + 1]
  ResultArray margin;                      ///< float64 [R, N + 1]
  ResultArray samples;                     ///< int32 [R]
  ResultArray outcome;                     ///< uint8 [R]
  std::vector<std::string> outcome_names;  ///< of 0, 1, ...
};

}  // namespace coordreq
