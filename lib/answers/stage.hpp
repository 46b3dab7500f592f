#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/archive.hpp"
#include "base/thread_team.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

class Answers;

/// Hands what there is to an archive, see Archive.
using Serialise = std::function<void(Archive&)>;

/// Where what the stage under way has found is kept, and taken up again later.
class StageStore {
 public:
  virtual ~StageStore() = default;

  enum class Kept : std::uint8_t { nothing, unfinished, finished };
  /// Loads what is kept of this stage, if anything is.
  /// @throws ResultsError if that is something else
  [[nodiscard]] virtual Kept take(const Serialise& load) = 0;
  /// The stage is over: from now on its result is kept. What `save` refers to must stay where it is.
  virtual void finish(Serialise save) = 0;
  /// The stage has come this far; kept if it is time.
  virtual void step(const Serialise& save) = 0;
};

/// What a stage is worked out with.
struct StageWork {
  ThreadTeam& team;
  /// Told that a part of the stage begins: "projections", or "" for the stage itself; may be empty.
  std::function<void(const std::string& part)> part = {};
  /// Told of every step of a fixed point, and how many cells a row has; may be empty.
  std::function<void(const WaveStep& step, std::int64_t row_length)> step = {};
  StageStore* store = nullptr;  ///< may be none

  void enter_part(const std::string& name) const {
    if (part) part(name);
  }
};

/// A piece of work with a name, by which progress, timings and checkpoints know it.
struct Stage {
  std::string name;
  /// Adds what it finds to what is known so far.
  std::function<void(Answers& answers, const StageWork& work)> run;
};

}  // namespace coordreq
