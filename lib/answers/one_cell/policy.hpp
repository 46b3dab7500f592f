#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "model/input_class.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The value that a field has at a cell, INT32_MAX where it has no end.
using CellValue = std::function<std::int32_t(std::int64_t cell)>;

/// Fields of bytes that are over less than cells, as an answer keeps tables in them.
class ByteTables {
 public:
  virtual ~ByteTables() = default;
  /// The length of an axis.
  [[nodiscard]] virtual std::int64_t length(const std::string& scale) const = 0;
  /// The bytes along the last axis of a field, at a place along all others.
  [[nodiscard]] virtual std::vector<std::uint8_t> bytes(const std::string& path,
                                                        const std::vector<std::int64_t>& place) const = 0;
};

/// What policies stand on: a results file, or arrays in memory.
struct PolicyGround {
  const ProblemSpec* spec = nullptr;
  const PartitionSpec* partition = nullptr;  ///< the one at hand
  const ByteTables* tables = nullptr;
  CellPosts* posts = nullptr;
  /// The values of a field of integers, by path; of the partition at hand where it is over these. In a loop:
  /// of AnswerPolicy::delay and its aim.
  std::function<CellValue(const std::string& path)> values;
};

/// What a policy leaves to agents at single cells. One object a thread and partition.
class CellPolicy {
 public:
  using Numbers = std::vector<std::int64_t>;  ///< of joint inputs or of actions, ascending

  CellPolicy() = default;
  CellPolicy(const CellPolicy&) = delete;
  CellPolicy& operator=(const CellPolicy&) = delete;
  virtual ~CellPolicy() = default;

  /// Whether the policy holds in a cell; where it does not agents go by the one before it in the plan.
  [[nodiscard]] virtual bool holds(std::int64_t cell) = 0;
  /// The joint inputs that agents who coordinate choose from. @param admissible C(x)
  /// @pre unchecked: the policy holds in the cell, which is in K.
  /// @returns what may change with the next call, or the argument
  [[nodiscard]] virtual const Numbers& together(std::int64_t cell, const Numbers& admissible) = 0;
  /// The actions that each class may take by itself with so many steps of silence left: [class]. By default
  /// the projections of `together`, whatever the countdown is.
  [[nodiscard]] virtual std::vector<Numbers> alone(std::int64_t cell, std::int32_t countdown,
                                                   const Numbers& together,
                                                   const std::vector<InputClass>& classes);
  /// The countdown that begins with a joint input on which agents agree at a cell, before it is known where
  /// that leads; nothing: it is the delay of the cell that is next.
  [[nodiscard]] virtual std::optional<std::int32_t> countdown_after(std::int64_t /*cell*/,
                                                                    std::int64_t /*u*/) {
    return std::nullopt;
  }
};

/// Which class may do what at a cell and a countdown, as an answer declares it: for the loop of `simulate`,
/// for `query`, and for the C header.
struct AnswerPolicy {
  /// Key of its group in JSON, and part of names: "approach"; empty: that of the delays, which holds
  /// everywhere.
  std::string name = {};
  std::string words = {};  ///< "actions", "approach": before " of CLASS"
  std::string gain = {};   ///< what agents who are silent by it do: "loses no time"; of those with a name
  /// Paths of steps over partitions: for how long the agents can do without coordination, and until they must
  /// start to connect. Empty: it is no policy of a loop; the second alone: what the first says is all.
  std::string delay = {}, trigger = {};
  /// Steps within which agents who follow it are at its aim, 0 there; a run that has been there follows it no
  /// longer. Beyond a side by which the domain is left for good they are 0 too, unless it is one that is
  /// `safe` alone.
  struct Aim {
    std::string path;   ///< over cells alone; empty: it has none
    std::string words;  ///< what the steps are
  };
  Aim aim = {};
  /// Runs follow it only if they are asked to, by an option of its name, and then wherever they are.
  /// `trigger` is then the countdown that it knows, and what classes may do goes by it.
  bool is_on_request = false;
  bool is_anywhere = false;  ///< it is about all cells of S
  bool is_by_agent = false;  ///< it is of agents, each by itself, whatever the partition is
  std::unique_ptr<CellPolicy> (*make)(const PolicyGround& ground) = nullptr;
  /// Where the actions of a class are stored on request, by its number; null: nowhere.
  std::string (*stored)(const ProblemSpec& spec, const PartitionSpec& partition, std::size_t c) = nullptr;
  /// Comments of a C header: where it holds ("on the way to the goal"), of the policy, its countdowns, its
  /// actions. Of those that have a trigger, but the first.
  struct HeaderComments {
    std::string where, purpose, countdown, allowed;
  };
  HeaderComments header = {};

  [[nodiscard]] const std::string& countdown() const { return trigger.empty() ? delay : trigger; }
};

}  // namespace coordreq
