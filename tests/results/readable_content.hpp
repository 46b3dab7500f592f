#pragma once

#include "results/sample_content.hpp"

namespace coordreq::sample {

/// make_content() with a spec that it fits, so that ResultsReader takes it: agents a, b and c with the inputs
/// u1 (5 values), u2 (3) and u3 (2), partitions "alone" and "a|b+c".
[[nodiscard]] ResultContent readable_content(const Options& options = {.points = {6, 5, 4}});

}  // namespace coordreq::sample
