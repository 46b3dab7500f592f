#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "answers/one_cell/policy.hpp"
#include "base/json.hpp"

namespace coordreq {

/// What an answer stands on when it adds to the explanation of a delay.
struct ExplainGround {
  const ProblemSpec* spec = nullptr;
  std::int32_t delay = 0;   ///< of the cell, as `/delay`
  bool is_bounded = false;  ///< there is a way out, see DelayExplanation
  /// What a policy leaves at the cell: [class or agent][action].
  std::function<std::vector<std::vector<bool>>(const AnswerPolicy& policy)> actions;
};

/// What it adds: a member of the document, and sentences about that.
struct Explained {
  std::string key;
  std::shared_ptr<Json> found;
  std::vector<std::string> sentences = {};
};

}  // namespace coordreq
