#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/action_sources.hpp"
#include "engine/row_engine.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// The actions of one class in one row, sorted into groups that cannot be told apart there: same post, tube
/// and `allow` whatever the other classes do. Groups are numbered by their first actions.
struct ActionGroups {
  std::vector<std::uint32_t> group_of;        ///< [action]
  std::vector<std::uint32_t> representative;  ///< [group], its lowest action
  /// Groups g for which no other group has its post (and tube) inside that of g: enough wherever *some*
  /// action is asked for.
  std::vector<std::uint32_t> minimal;
  /// Groups g whose post is in that of no other group: enough where *every* action is asked for.
  std::vector<std::uint32_t> maximal;
  std::vector<std::uint32_t> all;  ///< 0, 1, ..., size() - 1
  /// [g * size() + h], see is_within(); empty if there are too many groups to compare.
  std::vector<std::uint8_t> within;

  /// Of each group g those h != g that it is within, ascending: holders[g] of is_within(g, h). Few, as most
  /// boxes are in few others.
  std::vector<std::vector<std::uint32_t>> holders;

  /// True if, whatever the others do, the post under g lies inside the post under h (and so do the tubes),
  /// and `allow` says the same of both. May be false where that is not easily seen.
  [[nodiscard]] bool is_within(std::uint32_t g, std::uint32_t h) const {
    return !within.empty() && within[g * size() + h] != 0;
  }
  [[nodiscard]] std::size_t size() const { return representative.size(); }
};

/// The groups of all classes in one row.
struct RowGroups {
  std::vector<const ActionGroups*> classes;
  std::vector<ActionGroups> own;  ///< storage for what is not shared between rows
};

/// Finds the groups of a row. On a grid most inputs move a cell to the same box; a row of the circle has 25
/// joint groups for its 1681 joint inputs.
///
/// What a class can do depends on few states (its own vehicle, say), so the groups are found once for each
/// choice of those and looked up for every row.
class ActionGrouping {
 public:
  /// @pre the classes are a partition of all inputs. @pre unchecked: `engine` outlives this object
  ActionGrouping(const RowEngine& engine, const std::vector<InputClass>& classes, ThreadTeam& team)
      : ActionGrouping(engine, classes, action_sources(engine), team) {}
  /// Told apart by other sources.
  ActionGrouping(const RowEngine& engine, const std::vector<InputClass>& classes,
                 std::vector<ActionSource> sources, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const { return classes_.size(); }
  [[nodiscard]] const InputClass& operator[](std::size_t c) const { return classes_[c].inputs; }

  void group(const RowPlace& place, RowGroups& groups) const;

  [[nodiscard]] const RowEngine& engine() const { return *engine_; }
  /// What tells actions apart: usually the engine's slices in order (posts, then tubes), then `allow` if
  /// there is one.
  [[nodiscard]] const std::vector<ActionSource>& sources() const { return sources_; }
  /// What action `a` of class c adds to an entry's position in source t.
  [[nodiscard]] std::int64_t contribution(std::size_t c, std::size_t t, std::uint32_t a) const {
    return classes_[c].contribution[t][a];
  }

 private:
  /// What one table (or `allow`, the last one) says of the actions of a class.
  struct View {
    std::size_t table = 0;
    /// Every combination is told apart, in every row.
    bool all_distinct = false;
    /// Numbers of equal columns, [row choice * width + combination]; empty: the table uses no other class's
    /// inputs and its ids serve directly.
    std::vector<std::uint32_t> partial;
    std::int64_t width = 1;                 ///< combinations of the class's inputs that the table uses
    std::vector<std::int32_t> combination;  ///< [action]
  };
  struct ClassData {
    InputClass inputs;
    std::vector<View> views;
    std::vector<std::vector<std::int64_t>>
        contribution;  ///< [table][action]: offset of the action in the table
    std::vector<std::int64_t>
        state_stride;                   ///< into `shared`, by state; 0 where the class does not depend on it
    std::vector<std::uint32_t> shared;  ///< choice of those states -> number in `distinct`; empty: not shared
    std::int64_t before = 0;            ///< choices in front of those that are held
    std::vector<ActionGroups> distinct;
  };

  [[nodiscard]] ClassData make_class(const InputClass& inputs) const;
  [[nodiscard]] View make_view(std::size_t table, const ClassData& data) const;
  void share_groups(ClassData& data, ThreadTeam& team) const;
  [[nodiscard]] RowShare::Range held_choices(const ClassData& data, std::int64_t choices) const;
  [[nodiscard]] ActionGroups find_groups(const ClassData& data, const RowPlace& place) const;
  void compare_groups(const ClassData& data, const RowPlace& place, ActionGroups& groups) const;
  /// Numbers of the combinations in a row; null where they are their own.
  [[nodiscard]] const std::uint32_t* view_ids(const View& view, const RowPlace& place) const;

  const RowEngine* engine_;
  std::vector<ActionSource> sources_;
  std::vector<ClassData> classes_;
};

}  // namespace coordreq
