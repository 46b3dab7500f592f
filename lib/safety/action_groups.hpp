#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "safety/row_engine.hpp"

namespace coordreq {

/// Inputs that are chosen together; its joint actions are numbered row-major, the last input fastest.
using InputClass = std::vector<std::int32_t>;

/// Actions of each class that cannot be told apart in a row: same post and same `allow` whatever the others
/// do. Groups are numbered by their first actions.
struct RowGroups {
  struct Class {
    std::vector<std::uint32_t> group_of;        ///< [action]
    std::vector<std::uint32_t> representative;  ///< [group], the lowest action
  };
  std::vector<Class> classes;
};

/// Finds the groups of a row. On a grid most inputs move a cell to the same box; a row of the circle has 25
/// joint groups for its 1681 joint inputs.
class ActionGrouping {
 public:
  /// REQUIRES: the classes are a partition of all inputs; `engine` outlives this object.
  ActionGrouping(const RowEngine& engine, std::vector<InputClass> classes);

  [[nodiscard]] std::size_t size() const { return classes_.size(); }
  [[nodiscard]] const InputClass& inputs(std::size_t c) const { return classes_[c].inputs; }
  /// Number of joint actions of class c.
  [[nodiscard]] std::int64_t actions(std::size_t c) const { return classes_[c].actions; }

  void group(std::int64_t row, RowGroups& groups) const;

  /// Visits all choices of one group a class.
  class Tuples {
   public:
    Tuples(const ActionGrouping& grouping, std::int64_t row, const RowGroups& groups);
    /// Group chosen in each class.
    [[nodiscard]] std::span<const std::uint32_t> chosen() const { return chosen_; }
    /// Numbers of the slices, one a table, for RowEngine::inside.
    [[nodiscard]] std::span<const std::uint32_t> slice_ids();
    /// Allowed cells of the row; empty if everything is allowed.
    [[nodiscard]] ConstRow allowed() const;
    /// @returns false after the last choice
    bool next();
    /// Number of choices in all.
    [[nodiscard]] std::int64_t count() const;

   private:
    [[nodiscard]] std::int64_t contribution(std::size_t c, std::size_t table) const;

    const ActionGrouping& grouping_;
    const RowGroups& groups_;
    std::vector<std::int64_t> bases_;  ///< by table, then that of `allow`
    std::vector<std::uint32_t> chosen_;
    std::vector<std::uint32_t> ids_;
  };

 private:
  /// What one table (or `allow`, the last one) says of the actions of a class.
  struct View {
    std::size_t table = 0;
    std::vector<std::uint32_t>
        partial;             ///< numbers of equal columns, [row choice * width + combination]; empty: the
                             ///< table uses no other class's inputs and its ids serve directly
    std::int64_t width = 1;  ///< combinations of the class's inputs that the table uses
    std::vector<std::int32_t> combination;  ///< [action]
  };
  struct ClassData {
    InputClass inputs;
    std::int64_t actions = 1;
    std::vector<View> views;
    std::vector<std::vector<std::int64_t>>
        contribution;  ///< [table][action]: offset of the action in the table
  };
  /// The tables of the engine and `allow` seen alike.
  struct Source {
    std::vector<std::uint32_t> ids;  ///< of `allow`: rows with equal bits have equal numbers
    const std::vector<std::uint32_t>* shared_ids = nullptr;
    std::vector<std::int64_t> state_stride;
    std::vector<std::int64_t> input_stride;
    std::vector<std::int32_t> inputs;
    std::int64_t input_combinations = 1;
    [[nodiscard]] const std::vector<std::uint32_t>& all() const { return shared_ids ? *shared_ids : ids; }
  };

  void add_sources();
  [[nodiscard]] ClassData make_class(InputClass inputs) const;
  [[nodiscard]] View make_view(std::size_t table, const ClassData& data) const;
  [[nodiscard]] std::int64_t source_base(std::int64_t row, std::size_t table) const;

  const RowEngine* engine_;
  std::vector<Source> sources_;
  std::vector<ClassData> classes_;
};

}  // namespace coordreq
