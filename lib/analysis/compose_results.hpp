#pragma once

#include <deque>

#include "answers/answers.hpp"
#include "answers/coalition/answer.hpp"
#include "answers/convention/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/network/answer.hpp"
#include "results/result_content.hpp"

namespace coordreq {

/// What the results file of an analysis holds. The arrays refer to the answers and to the composer, which
/// must outlive the writing.
class ResultComposer {
 public:
  ResultComposer(const Answers& answers, ThreadTeam& team)
      : answers_(answers), ground_(answers.ground), team_(team) {}
  ResultComposer(const ResultComposer&) = delete;
  ResultComposer& operator=(const ResultComposer&) = delete;

  [[nodiscard]] ResultContent content();

 private:
  [[nodiscard]] std::vector<ResultAxis> axes() const;
  [[nodiscard]] ResultPartition partition_content(std::size_t p, ElementType type);
  [[nodiscard]] ResultBits bits(const ActionGrouping& grouping, std::size_t c, const std::string& name) const;
  void add_convention(const ConventionAnswer& convention, ResultContent& content) const;
  [[nodiscard]] ResultBits listed_bits() const;
  [[nodiscard]] std::vector<ResultTable> tables() const;
  void add_network(const NetworkSafety& network, ResultContent& content) const;

  const Answers& answers_;
  const Ground& ground_;
  ThreadTeam& team_;
  std::deque<ActionGrouping> groupings_;  ///< that arrays refer to
};

/// Adds `/coalition` and, where there is more than one agent, `/critical_pair` with its axis `/pair`. The
/// arrays refer to the answers, which must outlive the writing.
void add_coalitions(const Answers& answers, const CoalitionMap& map, ResultContent& content);

}  // namespace coordreq
