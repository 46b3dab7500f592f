#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "answers/one_cell/policy.hpp"
#include "base/json.hpp"

namespace coordreq {

/// The data from which an answer adds to the explanation of a delay.
struct ExplainContext {
  const ProblemSpec* spec = nullptr;
  const PartitionSpec* partition = nullptr;
  CellPosts* posts = nullptr;
  std::int64_t cell = 0;
  std::int32_t delay = 0;   ///< of the cell, as `/delay`
  bool is_bounded = false;  ///< the delay is bounded, so that there is a way out: see DelayExplanation
  /// The values of a field of integers; those of the partition if the field is over partitions.
  std::function<CellValue(const std::string& path)> values;
  /// A_c of a cell: the projections of C on the classes, [class][action].
  std::function<std::vector<std::vector<bool>>(std::int64_t cell)> projections;
  /// The actions that a policy leaves at the cell: [class or agent][action].
  std::function<std::vector<std::vector<bool>>(const AnswerPolicy& policy)> actions;
};

/// A contribution to an explanation: a member of the document, and sentences about it; none if the key is
/// empty.
struct Explained {
  std::string key;
  std::shared_ptr<Json> json;
  std::vector<std::string> sentences = {};
};

}  // namespace coordreq
