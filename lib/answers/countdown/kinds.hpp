#pragma once

#include <string>

namespace coordreq {

/// A kind of countdown: from a base set, under a choice of sets of actions, for how many steps is it safe?
/// All kinds have layers, which are found, stored, summarised and checked alike.
struct CountdownKind {
  const char* name;     ///< its member of a partition in JSON; empty: that of delays, which are the partition
  char letter;          ///< of its layers: Z_0, Z_1, ...
  const char* layered;  ///< path of the steps that say in which layers a cell is
  const char* label;    ///< for its layers, in findings

  /// What the paths of `layer`, `layer_size` and `fixed_point_index` begin with.
  [[nodiscard]] std::string prefix() const { return *name == '\0' ? "/" : "/" + std::string(name) + "_"; }
};

/// Choices: IND_C; base: K.
inline constexpr CountdownKind kDelayKind{"", 'Z', "/delay", "layers"};
/// IND_P; the goal, in which layers are those of delays, and W.
inline constexpr CountdownKind kApproachKind{"approach", 'A', "/approach_delay", "approach layers"};
/// What classes choose by what they see; K.
inline constexpr CountdownKind kBlindKind{"blind", 'B', "/blind_countdown", "blind layers"};
/// What the communication-loss rule permits; the set in which the fallback rule is safe, else K.
inline constexpr CountdownKind kSilenceKind{"silence", 'L', "/silence", "silence layers"};

}  // namespace coordreq
