#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/action_sources.hpp"
#include "engine/row_engine.hpp"
#include "engine/shared_list_numbers.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// The actions of one class in one row, sorted into groups: actions of a group have the same post, tube and
/// `allow` in the row, whatever the other classes do. Groups are numbered by their first actions.
struct ActionGroups {
  std::vector<std::uint32_t> group_of;        ///< [action]
  std::vector<std::uint32_t> representative;  ///< [group], its lowest action
  /// Groups with no other group's post (and tube) inside theirs: enough wherever *some* action is asked for.
  std::vector<std::uint32_t> minimal;
  /// Groups whose post is inside no other group's: enough where *every* action is asked for.
  std::vector<std::uint32_t> maximal;
  std::vector<std::uint32_t> all;  ///< 0, 1, ..., size() - 1
  /// [g * size() + h] is_within(g, h); empty if there are too many groups to compare.
  std::vector<std::uint8_t> within;

  /// [g] the other groups h with is_within(g, h), ascending. Few, as most boxes are in few others.
  std::vector<std::vector<std::uint32_t>> holders;

  /// True if, whatever the other classes do, the post under g lies inside the post under h (and so do the
  /// tubes), and `allow` permits both at the same cells. False also where that is not seen from the slices.
  [[nodiscard]] bool is_within(std::uint32_t g, std::uint32_t h) const {
    return !within.empty() && within[g * size() + h] != 0;
  }
  [[nodiscard]] std::size_t size() const { return representative.size(); }
};

/// The groups of all classes in one row.
struct RowGroups {
  std::vector<const ActionGroups*> classes;
  std::vector<ActionGroups> unshared;  ///< [class] storage for groups that are not shared between rows
};

/// Finds the groups of a row.
///
/// Why: on a grid most inputs move a cell to the same box, so that few groups stand for many actions; a row
/// of the circle has 25 joint groups for its 1681 joint inputs (FastPaths::grouped_actions). The posts of a
/// class depend on few states, those of its own vehicle, say, so groups are found once for each choice of
/// these states and looked up for every row (shared_groups); and posts inside others need not be tried
/// (covered_actions). Together they made the layers of the gridworld four times faster.
class ActionGrouping {
 public:
  /// @pre the classes are a partition of all inputs. @pre unchecked: `engine` outlives this object
  ActionGrouping(const RowEngine& engine, const std::vector<InputClass>& classes, ThreadTeam& team)
      : ActionGrouping(engine, classes, action_sources(engine), team) {}
  /// With sources of its own instead of those of the engine.
  ActionGrouping(const RowEngine& engine, const std::vector<InputClass>& classes,
                 std::vector<ActionSource> sources, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const { return classes_.size(); }
  [[nodiscard]] const InputClass& operator[](std::size_t c) const { return classes_[c].inputs; }

  void group(const RowPosition& position, RowGroups& groups) const;

  [[nodiscard]] const RowEngine& engine() const { return *engine_; }
  /// The tables that tell actions apart: usually the engine's slices in order (posts, then tubes), then
  /// `allow` if there is one.
  [[nodiscard]] const std::vector<ActionSource>& sources() const { return sources_; }
  /// The number that action `a` of class c adds to an entry's position in source t.
  [[nodiscard]] std::int64_t contribution(std::size_t c, std::size_t t, std::uint32_t a) const {
    return classes_[c].contribution[t][a];
  }

 private:
  /// One source, as it tells the actions of a class apart.
  struct View {
    std::size_t table = 0;
    /// Every combination is distinguished, in every row.
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
    std::vector<std::uint32_t> shared;  ///< [choice of these states] number in `distinct`; empty: not shared
    std::int64_t before = 0;            ///< choices before the first one in `shared`
    std::array<std::vector<ActionGroups>, SharedListNumbers::kShards> distinct;  ///< [shard][number in it]
  };

  [[nodiscard]] ClassData make_class(const InputClass& inputs) const;
  [[nodiscard]] View make_view(std::size_t table, const ClassData& data) const;
  void share_groups(ClassData& data, ThreadTeam& team) const;
  [[nodiscard]] RowShare::Range held_choices(const ClassData& data, std::int64_t choices) const;
  [[nodiscard]] ActionGroups find_groups(const ClassData& data, const RowPosition& position) const;
  void compare_groups(const ClassData& data, const RowPosition& position, ActionGroups& groups) const;
  /// [combination] its number in a row; null: each is its own number.
  [[nodiscard]] const std::uint32_t* view_ids(const View& view, const RowPosition& position) const;

  const RowEngine* engine_;
  std::vector<ActionSource> sources_;
  std::vector<ClassData> classes_;
};

}  // namespace coordreq
