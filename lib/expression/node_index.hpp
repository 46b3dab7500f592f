#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/requires.hpp"
#include "expression/program.hpp"

namespace coordreq {

/// Finds equal nodes among those of a tape.
///
/// An open hash table of indices rather than a std::unordered_map: a chain of n definitions copies n^2/2
/// nodes through it, and an allocation each would take most of that time.
class NodeIndex {
 public:
  /// The index of a node equal to `node` in `nodes`; it is appended if there is none.
  /// @pre unchecked: `nodes` is what earlier calls made of it.
  std::uint32_t find_or_append(const Program::Node& node, std::vector<Program::Node>& nodes) {
    if (2 * (nodes.size() + 1) > buckets_.size()) rebuild(nodes);
    std::size_t bucket = bucket_of(node);
    while (buckets_[bucket] != kEmpty) {
      if (are_equal(nodes[buckets_[bucket]], node)) return buckets_[bucket];
      bucket = (bucket + 1) & (buckets_.size() - 1);
    }
    buckets_[bucket] = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(node);
    return buckets_[bucket];
  }

  /// Makes room for `count` nodes, the ones in `nodes` included.
  void reserve(std::size_t count, const std::vector<Program::Node>& nodes) {
    if (2 * count > buckets_.size()) rebuild(nodes, count);
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

  static bool are_equal(const Program::Node& a, const Program::Node& b) {
    return a.op == b.op && a.a == b.a && a.b == b.b && a.c == b.c;
  }

  /// @pre there are buckets; their number is a power of two
  [[nodiscard]] std::size_t bucket_of(const Program::Node& node) const {
    REQUIRES(std::has_single_bit(buckets_.size()));
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;
    std::uint64_t hash = static_cast<std::uint64_t>(node.op) * kOdd;
    for (const std::uint32_t operand : {node.a, node.b, node.c})
      hash = (std::rotl(hash, 23) ^ operand) * kOdd;
    return (hash >> 32U) & (buckets_.size() - 1);
  }

  void rebuild(const std::vector<Program::Node>& nodes, std::size_t count = 0) {
    constexpr std::size_t kFewest = 16;
    buckets_.assign(std::bit_ceil(4 * std::max({count, nodes.size(), kFewest})), kEmpty);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      std::size_t bucket = bucket_of(nodes[i]);
      while (buckets_[bucket] != kEmpty) bucket = (bucket + 1) & (buckets_.size() - 1);
      buckets_[bucket] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<std::uint32_t> buckets_;
};

}  // namespace coordreq
