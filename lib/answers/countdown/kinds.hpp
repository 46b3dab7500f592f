#pragma once

#include <array>
#include <string>

namespace coordreq {

/// How runs of `simulate` follow a kind, if only by an option of its own.
struct CountdownOption {
  const char* name = nullptr;  ///< with its "--"; null: no option, runs follow the kind where it holds
  const char* description = nullptr;
  bool takes_steps = false;         ///< for how many steps the agents follow it
  const char* missing = nullptr;    ///< the error where a spec does not have the kind
  const char* no_prefer = nullptr;  ///< errors with `--policy prefer`, `--until` and `--lossy`; null: allowed
  const char* no_until = nullptr;
  const char* no_lossy = nullptr;
  const char* no_start = nullptr;  ///< the error where a run cannot start in S; null: that of K

  /// Its member in JSON, and its attribute in files of runs.
  [[nodiscard]] const char* key() const { return name + 2; }
};

/// A kind of countdown: from a base set, under a choice of sets of actions, for how many steps is it safe?
/// All kinds have layers, which are found, stored, summarised and checked alike.
struct CountdownKind {
  const char* name;     ///< its member of a partition in JSON; empty: that of delays, which are the partition
  char letter;          ///< of its layers: Z_0, Z_1, ...
  const char* layered;  ///< path of the steps that say in which layers a cell is
  const char* label;    ///< for its layers, in findings
  CountdownOption option = {};

  /// What the paths of `layer`, `layer_size` and `fixed_point_index` begin with.
  [[nodiscard]] std::string prefix() const { return *name == '\0' ? "/" : "/" + std::string(name) + "_"; }
};

/// Choices: IND_C; base: K.
inline constexpr CountdownKind kDelayKind{"", 'Z', "/delay", "layers"};
/// IND_P; the goal, in which layers are those of delays, and W.
inline constexpr CountdownKind kApproachKind{"approach", 'A', "/approach_delay", "approach layers"};
/// What classes choose by what they see; K.
inline constexpr CountdownKind kBlindKind{
    "blind",
    'B',
    "/blind_countdown",
    "blind layers",
    {.name = "--blind",
     .description = "During silence each class uses only the states that it sees, with its silent table",
     .missing = "all agents see all states, expected some that do not: 'sees' in the spec",
     .no_prefer = "'prefer' reads what agents do not see, expected random or adversarial with --blind",
     .no_until = "agents with own observations only do not pursue the goal, expected --blind or --until",
     .no_lossy = "agents with own observations only know that a step is lost, not the mode; expected --blind "
                 "or --lossy"}};
/// What the communication-loss rule permits; the set in which the fallback rule is safe, else K.
inline constexpr CountdownKind kSilenceKind{
    "silence",
    'L',
    "/silence",
    "silence layers",
    {.name = "--silent",
     .description =
         "Follow the communication-loss rule for N steps, then the fallback rule; without N, until S is left",
     .takes_steps = true,
     .missing = "the spec has no communication-loss rule, expected the key 'silence'",
     .no_until =
         "agents under the communication-loss rule do not pursue the goal, expected --silent or --until",
     .no_lossy = "the network says when steps are lost, expected --silent or --lossy",
     .no_start = "the start is not in the silence set: the fallback rule is not safe from there"}};

inline constexpr std::array kCountdownKinds{&kDelayKind, &kApproachKind, &kBlindKind, &kSilenceKind};

}  // namespace coordreq
