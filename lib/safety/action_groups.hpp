#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/thread_team.hpp"
#include "safety/action_sources.hpp"
#include "safety/row_engine.hpp"

namespace coordreq {

/// Inputs that are chosen together; its joint actions are numbered row-major, the last input fastest.
using InputClass = std::vector<std::int32_t>;

/// The actions of one class in one row, sorted into groups that cannot be told apart there: same post, tube
/// and `allow` whatever the other classes do. Groups are numbered by their first actions.
struct ActionGroups {
  std::vector<std::uint32_t> group_of;        ///< [action]
  std::vector<std::uint32_t> representative;  ///< [group], its lowest action
  /// Groups g for which no other group has its post (and tube) inside that of g: enough wherever *some*
  /// action is asked for.
  std::vector<std::uint32_t> minimal;
  /// [g * size() + h], see is_within(); empty if there are too many groups to compare.
  std::vector<std::uint8_t> within;

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
  /// REQUIRES: the classes are a partition of all inputs; `engine` outlives this object.
  ActionGrouping(const RowEngine& engine, std::vector<InputClass> classes, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const { return classes_.size(); }
  [[nodiscard]] const InputClass& inputs(std::size_t c) const { return classes_[c].inputs; }
  /// Number of joint actions of class c.
  [[nodiscard]] std::int64_t actions(std::size_t c) const { return classes_[c].actions; }

  void group(std::int64_t row, RowGroups& groups) const;

  /// Visits all choices of one candidate group a class.
  class Tuples {
   public:
    /// @param candidates groups of each class to choose from; REQUIRES: none is empty
    Tuples(const ActionGrouping& grouping, std::int64_t row, const RowGroups& groups,
           std::vector<std::vector<std::uint32_t>> candidates);
    /// Group chosen in class c.
    [[nodiscard]] std::uint32_t chosen(std::size_t c) const { return candidates_[c][position_[c]]; }
    /// Numbers of the slices, one for each of RowEngine::slices(), for RowEngine::inside.
    [[nodiscard]] std::span<const std::uint32_t> slice_ids();
    /// Allowed cells of the row; empty if everything is allowed.
    [[nodiscard]] ConstRow allowed() const;
    /// @returns false after the last choice
    bool next();

   private:
    void add_up(std::size_t from_class);

    const ActionGrouping& grouping_;
    std::vector<std::vector<std::uint32_t>> candidates_;
    std::size_t tables_;                             ///< of slices, and one more if there is `allow`
    std::vector<std::vector<std::int64_t>> offset_;  ///< [class][position of the candidate * tables_ + table]
    std::vector<std::int64_t> sum_;                  ///< [classes added up * tables_ + table], bases first
    std::vector<std::size_t> position_;
    std::vector<std::uint32_t> ids_;
  };

  /// All groups of every class.
  [[nodiscard]] static std::vector<std::vector<std::uint32_t>> all_groups(const RowGroups& groups);
  /// The minimal groups of every class.
  [[nodiscard]] static std::vector<std::vector<std::uint32_t>> minimal_groups(const RowGroups& groups);

 private:
  /// What one table (or `allow`, the last one) says of the actions of a class.
  struct View {
    std::size_t table = 0;
    /// Numbers of equal columns, [row choice * width + combination]; empty: the table uses no other class's
    /// inputs and its ids serve directly.
    std::vector<std::uint32_t> partial;
    std::int64_t width = 1;                 ///< combinations of the class's inputs that the table uses
    std::vector<std::int32_t> combination;  ///< [action]
  };
  struct ClassData {
    InputClass inputs;
    std::int64_t actions = 1;
    std::vector<View> views;
    std::vector<std::vector<std::int64_t>>
        contribution;  ///< [table][action]: offset of the action in the table
    std::vector<std::int64_t>
        state_stride;                   ///< into `shared`, by state; 0 where the class does not depend on it
    std::vector<std::uint32_t> shared;  ///< choice of those states -> number in `distinct`; empty: not shared
    std::vector<ActionGroups> distinct;
  };

  [[nodiscard]] ClassData make_class(InputClass inputs) const;
  [[nodiscard]] View make_view(std::size_t table, const ClassData& data) const;
  void share_groups(ClassData& data, ThreadTeam& team) const;
  [[nodiscard]] ActionGroups find_groups(const ClassData& data, std::int64_t row) const;
  void compare_groups(const ClassData& data, std::int64_t row, ActionGroups& groups) const;
  [[nodiscard]] const std::uint32_t* view_ids(const View& view, std::int64_t row) const;

  const RowEngine* engine_;
  std::vector<ActionSource> sources_;
  std::vector<ClassData> classes_;
};

}  // namespace coordreq
