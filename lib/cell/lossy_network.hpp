#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cell/random_stream.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

struct ProbabilityRange;

/// A network whose losses are drawn from its numbers.
class LossyNetwork {
 public:
  struct Mode {
    const PartitionSpec* partition = nullptr;
    bool is_connected = false;  ///< all agents are one class
    /// [mode that can follow] and up to where its numbers go, in units of 2^-64: the last up to the end.
    std::vector<std::pair<std::size_t, std::uint64_t>> next;
  };

  /// @pre the network has numbers. @pre unchecked: it outlives this object
  explicit LossyNetwork(const NetworkSpec& network);

  [[nodiscard]] const std::vector<Mode>& modes() const { return modes_; }
  /// The mode after another one.
  [[nodiscard]] std::size_t draw(std::size_t mode, RandomStream& random) const;

 private:
  std::vector<Mode> modes_;
};

/// The probabilities nearest to the middles of ranges, by least squares, that are 1 in sum: all are moved by
/// the same, but none beyond an end of its range. @pre the ranges hold some that are
[[nodiscard]] std::vector<Rational> likeliest(const std::vector<ProbabilityRange>& ranges);

}  // namespace coordreq
