#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/requires.hpp"
#include "choices/controller_row.hpp"
#include "engine/action_groups.hpp"
#include "engine/post_reader.hpp"
#include "engine/tuple_walk.hpp"

namespace coordreq {

/// The convention of the cells of one row (see convention_at()), by groups of actions: two actions of one
/// group are in the same pairs, so that a set holds all of a group or none.
struct ConventionRow {
  RowGroups groups;
  /// [agent], then [group * words + word]: the cells with the group in P_i(x), and those with the group in
  /// the projection of C(x) on the agent.
  std::vector<std::vector<Word>> kept;
  std::vector<std::vector<Word>> projection;
};

/// Works out one row after the other. One object a thread.
template <class Level>
class ConventionRows {
 public:
  /// @param agents the actions of each agent as a class of its own, in the order of the spec
  /// @param posts a reader of the levels, of which this object takes a copy
  /// @pre unchecked: all others outlive this object; `levels` are those of controller.levels.
  ConventionRows(const Controller& controller, const ActionGrouping& agents, const LevelRows<Level>& levels,
                 const PostReader<Level>& posts)
      : controller_(controller),
        levels_(levels),
        agents_(agents),
        words_(controller.engine->row_words()),
        posts_(posts) {
    for (std::size_t i = 0; i < agents.size(); ++i) offsets_.push_back(agents[i].offsets());
  }

  /// @pre some cell of the row is in K
  void find(const RowPosition& position, ConventionRow& row) {
    REQUIRES(any_set(controller_.invariant->row(position.row)));
    posts_.enter(position.row);
    agents_.group(position, row.groups);
    find_controller(position, row);
    find_seeds(controller_.invariant->row(position.row), row);
    for (std::size_t i = 0; i < agents_.size(); ++i)
      add_actions(i, controller_.invariant->row(position.row), row);
  }

 private:
  /// C(x) of all choices of groups, the last agent fastest, and its projections.
  void find_controller(const RowPosition& position, ConventionRow& row) {
    row.projection.resize(agents_.size());
    for (std::size_t i = 0; i < agents_.size(); ++i)
      row.projection[i].assign(row.groups.classes[i]->size() * words_, 0);
    choose_groups(row.groups, GroupChoice::all, candidates_);
    tuple_.begin(agents_, position, row.groups, candidates_);
    admissible_.clear();
    choices_.clear();
    numbers_.clear();
    std::vector<Word> members(words_);
    do {
      controller_row(controller_, levels_, position.row, tuple_, posts_, controller_.engine->all_lanes(),
                     members);
      admissible_.insert(admissible_.end(), members.begin(), members.end());
      std::int64_t number = 0;
      for (std::size_t i = 0; i < agents_.size(); ++i) {
        const std::uint32_t g = tuple_.chosen(i);
        choices_.push_back(g);
        number += offsets_[i][row.groups.classes[i]->representative[g]];
        for (std::size_t w = 0; w < words_; ++w) row.projection[i][g * words_ + w] |= members[w];
      }
      numbers_.push_back(number);
    } while (tuple_.next());
  }

  /// The first sets: the groups of the lowest-numbered joint input of every cell. The lowest joint input of a
  /// choice of groups has the lowest action of each group, as numbers grow with every agent's action.
  void find_seeds(ConstRow invariant, ConventionRow& row) {
    row.kept.resize(agents_.size());
    for (std::size_t i = 0; i < agents_.size(); ++i)
      row.kept[i].assign(row.groups.classes[i]->size() * words_, 0);
    order_.resize(numbers_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (!std::is_sorted(numbers_.begin(), numbers_.end())) {
      std::sort(order_.begin(), order_.end(),
                [this](std::size_t a, std::size_t b) { return numbers_[a] < numbers_[b]; });
    }
    std::vector<Word> open(invariant.begin(), invariant.end());
    for (const std::size_t t : order_) {
      for (std::size_t w = 0; w < words_; ++w) {
        const Word first = open[w] & admissible_[t * words_ + w];
        if (first == 0) continue;
        open[w] &= ~first;
        for (std::size_t i = 0; i < agents_.size(); ++i) row.kept[i][chosen(t, i) * words_ + w] |= first;
      }
      if (!any_set(open)) return;
    }
  }

  /// Adds to the set of agent i all groups that fit the present sets of the others.
  void add_actions(std::size_t i, ConstRow invariant, ConventionRow& row) {
    std::vector<Word>& kept = row.kept[i];
    refused_.assign(kept.size(), 0);
    for (std::size_t t = 0; t < numbers_.size(); ++t) {
      for (std::size_t w = 0; w < words_; ++w) {
        Word bad = invariant[w] & ~admissible_[t * words_ + w];
        for (std::size_t j = 0; bad != 0 && j < agents_.size(); ++j) {
          if (j != i) bad &= row.kept[j][chosen(t, j) * words_ + w];
        }
        refused_[chosen(t, i) * words_ + w] |= bad;
      }
    }
    for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = invariant[k % words_] & ~refused_[k];
  }

  [[nodiscard]] std::size_t chosen(std::size_t t, std::size_t i) const {
    return choices_[t * agents_.size() + i];
  }

  const Controller& controller_;
  const LevelRows<Level>& levels_;
  const ActionGrouping& agents_;
  std::size_t words_;
  PostReader<Level> posts_;
  std::vector<std::vector<std::int64_t>> offsets_;  ///< [agent][action]: its part of a joint input's number
  TupleWalk::Candidates candidates_;
  TupleWalk tuple_;
  std::vector<Word> admissible_;        ///< [choice of groups * words + word]
  std::vector<std::uint32_t> choices_;  ///< [choice of groups * agents + agent]
  std::vector<std::int64_t> numbers_;   ///< [choice of groups]: its lowest joint input
  std::vector<std::size_t> order_;
  std::vector<Word> refused_;
};

}  // namespace coordreq
