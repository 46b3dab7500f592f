#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "answers/requirements/escape_message.hpp"
#include "answers/requirements/escape_path.hpp"
#include "answers/requirements/escape_search.hpp"
#include "answers/requirements/real_run.hpp"
#include "engine/level_map.hpp"

namespace coordreq {

/// An escape that grows step by step, and the system itself beside it: a walk for EscapeSearch. With several
/// processes together: each step is found by the one that owns the cell.
class EscapeRun {
 public:
  /// @pre unchecked: `sets` outlive this object.
  explicit EscapeRun(const EscapeSets& sets);
  EscapeRun(const EscapeRun&) = delete;
  EscapeRun& operator=(const EscapeRun&) = delete;
  virtual ~EscapeRun() = default;

  /// Starts the system itself at a state, or at the centre of the cell.
  void begin_at(std::int64_t cell, const std::optional<std::vector<Rational>>& start);
  /// Begins an escape in a cell, that of the system itself.
  void begin_way(std::int64_t cell);

  /// The place of the system itself on the way; nothing if it is no longer followed.
  [[nodiscard]] std::optional<FollowedPlace> place() const;
  void go_to(const FollowedPlace& place);
  /// Takes a step, and the system itself with it. @returns the number of looks at joint inputs
  std::int64_t step(std::int64_t number);
  /// Whether there are equal steps of greater numbers than the last one.
  [[nodiscard]] bool has_more() const { return has_more_; }
  /// Whether the system itself has followed to the end, but for a last action that leads to no cell.
  [[nodiscard]] bool is_whole() const;

  /// Takes a step of the way alone; the system itself stays. @returns whether the way goes on
  bool step_alone(std::int64_t number);
  /// Moves the system itself to reached(), after step_alone().
  void advance() { real_.advance(path_.joint_inputs.back(), reached_.place); }
  [[nodiscard]] const Reached& reached() const { return reached_; }
  [[nodiscard]] bool goes_on() const { return goes_on_; }
  [[nodiscard]] EscapePath& path() { return path_; }

 protected:
  /// How the path goes on; unknown before the first step.
  enum class Way : std::uint8_t { unknown, together, approaching, silent, independent, evasive };

  /// Adds a step to the path, from the last cell, which this process owns. @returns whether to go on
  virtual bool add_step() = 0;
  [[nodiscard]] Way way() const { return way_; }
  void change_way(Way way) { way_ = way; }
  /// Which to take of equal joint inputs that the system itself can follow.
  [[nodiscard]] std::int64_t number() const { return number_; }
  void note_more(bool has_more) { has_more_ = has_more; }

  const EscapeSets& sets_;
  const AnalysisContext& context_;
  const LevelMap& collision_time_;
  TubeSets tubes_;
  CellPosts posts_;
  EscapePath path_;
  RealRun real_;

 private:
  [[nodiscard]] bool is_inside(std::int64_t cell) const;
  bool step_and_look();
  bool step_of_owner();

  Way way_ = Way::unknown;
  bool goes_on_ = true;
  std::int64_t number_ = 0;
  bool has_more_ = false;
  Reached reached_;
};

}  // namespace coordreq
