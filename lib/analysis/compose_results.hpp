#pragma once

#include <deque>

#include "analysis/solution.hpp"
#include "results/result_content.hpp"

namespace coordreq {

/// What the results file of a solution holds. The arrays refer to the solution and to the composer, which
/// must outlive the writing.
class ResultComposer {
 public:
  ResultComposer(const Solution& solution, ThreadTeam& team) : solution_(solution), team_(team) {}
  ResultComposer(const ResultComposer&) = delete;
  ResultComposer& operator=(const ResultComposer&) = delete;

  [[nodiscard]] ResultContent content();

 private:
  [[nodiscard]] std::vector<ResultAxis> axes() const;
  [[nodiscard]] ResultPartition partition_content(const PartitionResult& partition, ElementType type);
  [[nodiscard]] ResultBits bits(const ActionGrouping& grouping, std::size_t c, const std::string& name) const;
  void add_convention(ResultContent& content) const;
  [[nodiscard]] ResultBits listed_bits() const;
  [[nodiscard]] std::vector<ResultTable> tables() const;
  void add_network(ResultContent& content) const;

  const Solution& solution_;
  ThreadTeam& team_;
  std::deque<ActionGrouping> groupings_;  ///< that arrays refer to
};

}  // namespace coordreq
