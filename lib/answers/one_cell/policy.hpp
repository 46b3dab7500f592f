#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/countdown/kinds.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "model/input_class.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The value of a field at a cell; INT32_MAX if it is unbounded.
using CellValue = std::function<std::int32_t(std::int64_t cell)>;

/// Fields of bytes that are not over cells, in which answers keep tables.
class ByteTables {
 public:
  virtual ~ByteTables() = default;
  /// The length of an axis.
  [[nodiscard]] virtual std::int64_t length(const std::string& scale) const = 0;
  /// The bytes along the last axis of a field, at an index along all other axes.
  [[nodiscard]] virtual std::vector<std::uint8_t> bytes(const std::string& path,
                                                        const std::vector<std::int64_t>& indices) const = 0;
};

/// The data of policies: from a results file, or from arrays in memory.
struct PolicyContext {
  const ProblemSpec* spec = nullptr;
  const PartitionSpec* partition = nullptr;  ///< the partition that agents are in
  const ByteTables* tables = nullptr;
  CellPosts* posts = nullptr;
  /// The values of a field of integers, by path; those of the partition if the field is over partitions. In a
  /// loop: of AnswerPolicy::delay and its aim.
  std::function<CellValue(const std::string& path)> values;
};

/// The choices that a policy leaves to agents at single cells. One object a thread and partition.
class CellPolicy {
 public:
  using Numbers = std::vector<std::int64_t>;  ///< of joint inputs or of actions, ascending

  CellPolicy() = default;
  CellPolicy(const CellPolicy&) = delete;
  CellPolicy& operator=(const CellPolicy&) = delete;
  virtual ~CellPolicy() = default;

  /// Whether the policy holds in a cell; where it does not, agents follow the policy before it in the plan.
  [[nodiscard]] virtual bool holds(std::int64_t cell) = 0;
  /// The joint inputs that agents who coordinate choose from. @param admissible C(x)
  /// @pre unchecked: the policy holds in the cell, which is in K.
  /// @returns the argument, or a list that is valid until the next call
  [[nodiscard]] virtual const Numbers& together(std::int64_t cell, const Numbers& admissible) = 0;
  /// [class] The actions that each class may take by itself with `countdown` steps of silence left. By
  /// default the projections of `together`, for every countdown.
  [[nodiscard]] virtual std::vector<Numbers> alone(std::int64_t cell, std::int32_t countdown,
                                                   const Numbers& together,
                                                   const std::vector<InputClass>& classes);
  /// The countdown that begins with a joint input on which agents agree at a cell, before the next cell is
  /// known; nothing: it is the delay of the next cell.
  [[nodiscard]] virtual std::optional<std::int32_t> countdown_after(std::int64_t /*cell*/,
                                                                    std::int64_t /*u*/) {
    return std::nullopt;
  }
};

/// Which class may do what at a cell and a countdown, as an answer declares it: for the loop of `simulate`,
/// for `query`, and for the C header.
struct AnswerPolicy {
  /// Key of its group in JSON, and part of names: "approach"; empty: the policy of the delays, which holds
  /// everywhere.
  std::string name = {};
  const CountdownKind* kind = nullptr;  ///< whose layers say for how many steps it holds
  std::string label = {};               ///< "actions", "approach": before " of CLASS"
  std::string gain = {};  ///< what silent agents gain by it: "loses no time"; of policies with a name
  /// Of policies that answer how long silence is safe, other than that of the delays: after "3 steps of
  /// silence" in the sentence that says so. The last of them in the plan is what the spec asks for first.
  std::string headline = {};
  /// Paths of steps over partitions: for how long the agents can do without coordination, and until when they
  /// must start to connect. `delay` empty: not a policy of a loop; `trigger` empty: the policy has a delay
  /// alone.
  std::string delay = {}, trigger = {};
  /// Steps within which agents who follow the policy reach its aim, 0 in it; a run that has reached the aim
  /// follows the policy no longer, unless the aim lasts. Beyond a side through which the domain is left for
  /// good the steps are 0, too, unless the side is only `safe`.
  struct Aim {
    std::string path;   ///< of a field over cells alone; empty: the policy has no aim
    std::string label;  ///< for the steps
    bool lasts =
        false;  ///< the policy is followed indefinitely: in the aim it says more than that of the delays
  };
  Aim aim = {};
  bool is_anywhere = false;  ///< the policy is about all cells of S
  bool is_by_agent = false;  ///< the policy is of agents, each by itself, in every partition
  std::unique_ptr<CellPolicy> (*make)(const PolicyContext& context) = nullptr;
  /// What agents go by when the silence does not end within the requested steps; null: they coordinate.
  std::unique_ptr<CellPolicy> (*make_then)(const PolicyContext& context) = nullptr;
  /// The paths of what it reads from ByteTables in a partition; null: nothing.
  std::vector<std::string> (*tables)(const ProblemSpec& spec, const PartitionSpec& partition) = nullptr;
  /// The path of the actions of a class, by its number, if they are stored on request; null: they never are.
  std::string (*stored)(const ProblemSpec& spec, const PartitionSpec& partition, std::size_t c) = nullptr;
  /// Comments of a C header: where the policy holds ("on the way to the goal"), and about the policy, its
  /// countdowns, its actions. For policies with a trigger, but the first.
  struct HeaderComments {
    std::string where, purpose, countdown, allowed;
  };
  HeaderComments header = {};

  /// Runs follow the policy only on request, by the option of its kind, and then everywhere. `trigger` is
  /// then the countdown that agents know, by which the actions of classes are chosen.
  [[nodiscard]] bool is_on_request() const { return kind != nullptr && kind->option.name != nullptr; }
  [[nodiscard]] const std::string& countdown() const { return trigger.empty() ? delay : trigger; }
};

}  // namespace coordreq
