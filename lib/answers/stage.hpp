#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/archive.hpp"
#include "base/thread_team.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

class Answers;

/// Saves or loads a state by an archive, see Archive.
using Serialise = std::function<void(Archive&)>;

/// The store of the stage under way: keeps its state, which is resumed later.
class StageStore {
 public:
  virtual ~StageStore() = default;

  enum class Kept : std::uint8_t { nothing, unfinished, finished };
  /// Loads the kept state of this stage, if there is one.
  /// @throws ResultsError if the kept state is not one of this stage
  [[nodiscard]] virtual Kept take(const Serialise& load) = 0;
  /// The stage has ended: from now on its result is kept. Objects to which `save` refers must keep their
  /// addresses.
  virtual void finish(Serialise save) = 0;
  /// The stage has reached this state, which is kept if it is time.
  virtual void step(const Serialise& save) = 0;
};

/// The threads, observers and store with which a stage works.
struct StageWork {
  ThreadTeam& team;
  /// Called when a substage begins: "projections", or "" for the stage itself; may be empty.
  std::function<void(const std::string& substage)> substage = {};
  /// Called for every step of a fixed point, with the number of cells of a row; may be empty.
  std::function<void(const WaveStep& step, std::int64_t row_length)> step = {};
  StageStore* store = nullptr;  ///< may be null

  void enter_substage(const std::string& name) const {
    if (substage) substage(name);
  }
};

/// A piece of work with a name, by which progress, timings and checkpoints know it.
struct Stage {
  std::string name;
  /// Adds its results to the answers so far.
  std::function<void(Answers& answers, const StageWork& work)> run;
};

}  // namespace coordreq
