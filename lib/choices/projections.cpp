#include "choices/projections.hpp"

#include <algorithm>
#include <bit>
#include <deque>

#include "base/requires.hpp"
#include "choices/controller_row.hpp"
#include "choices/forbidden_choices.hpp"
#include "choices/pair_projection.hpp"
#include "engine/level_map.hpp"
#include "engine/post_reader.hpp"
#include "engine/tuple_walk.hpp"

namespace coordreq {
namespace {

std::size_t group_offset(const RowGroups& groups, std::size_t c) {
  std::size_t offset = 0;
  for (std::size_t i = 0; i < c; ++i) offset += groups.classes[i]->size();
  return offset;
}

/// From the first to the last lane of a set that another one lacks.
LaneRange missing_lanes(ConstRow set, ConstRow other) {
  LaneRange range;
  for (std::size_t w = 0; w < set.size(); ++w) {
    const Word missing = set[w] & ~other[w];
    if (missing == 0) continue;
    const std::size_t lane = w * CellSet::kWordBits;
    if (range.end == 0) range.begin = lane + static_cast<std::size_t>(std::countr_zero(missing));
    range.end = lane + static_cast<std::size_t>(std::bit_width(missing));
  }
  return range;
}

}  // namespace

/// Finds the projections of rows. One object a thread.
template <class Level>
class Projections::Builder {
 public:
  Builder(const Controller& controller, const ActionGrouping& grouping, const ForbiddenChoices& choices,
          const LevelRows<Level>& levels, const PostReader<Level>& posts, const SilentRules* rules,
          bool keeps_masks)
      : controller_(controller),
        rules_(rules),
        levels_(levels),
        keeps_masks_(keeps_masks),
        grouping_(grouping),
        choices_(choices),
        boxes_(grouping),
        pair_(controller, boxes_, grouping.size()),
        independent_(controller.engine->row_words()),
        posts_(posts),
        members_(controller.engine->row_words()),
        forbidden_(controller.engine->row_words()),
        masks_(grouping.size()) {}

  /// @returns the projections of a row, valid until the next call
  Found project(const RowPosition& position) {
    posts_.enter(position.row);
    if (rules_ != nullptr) return project_by_rules(position);
    const ConstRow invariant = controller_.invariant->row(position.row);
    grouping_.group(position, groups_);
    const bool is_product = boxes_.is_product() && boxes_.fill(position, groups_);
    is_simple_ = is_product && !boxes_.has_gone() && controller_.engine->allow() == nullptr &&
                 controller_.synthesis == Synthesis::maximal && !controller_.approaches;
    box_.resize(controller_.engine->grid());
    if (is_simple_ && pair_.applies()) {
      pair_.find_masks(position, groups_, masks_);
    } else {
      for (std::size_t c = 0; c < masks_.size(); ++c) find_masks(position, c);
    }
    Found found{.is_full = is_full(invariant)};
    if (is_product) {
      packed_.clear();
      independent_.pack(boxes_, groups_, masks_, invariant, controller_.engine->grid(), packed_);
      found.packed = packed_;
    }
    if (!found.is_full && (!is_product || keeps_masks_)) {
      join_masks();
      found.masks = joined_masks_;
    }
    if (choices_.find(position, groups_, masks_, work_, forbidden_)) found.forbidden = forbidden_;
    return found;
  }

 private:
  /// Whether the masks of all groups are all cells of K in the row, and nothing is forbidden.
  [[nodiscard]] bool is_full(ConstRow invariant) const {
    if (controller_.engine->allow() != nullptr) return false;
    return std::ranges::all_of(masks_, [&](const std::vector<Word>& masks) {
      for (std::size_t k = 0; k < masks.size(); ++k) {
        if (masks[k] != invariant[k % invariant.size()]) return false;
      }
      return true;
    });
  }

  Found project_by_rules(const RowPosition& position) {
    Found found;
    grouping_.group(position, groups_);
    // A class whose post has left for good fits all actions of the others.
    const bool is_product = boxes_.is_product() && boxes_.fill(position, groups_) && !boxes_.has_gone();
    is_simple_ = false;
    const ConstRow cells = rules_->cells->row(position.row);
    find_ruled(position, cells);
    if (!choices_.find(position, groups_, masks_, work_, forbidden_))
      std::fill(forbidden_.begin(), forbidden_.end(), 0);
    for (std::size_t w = 0; w < cells.size(); ++w) forbidden_[w] |= cells[w] & ~members_[w];
    if (is_product) {
      mark_blocked();
      packed_.clear();
      independent_.pack(boxes_, groups_, masks_, members_, controller_.engine->grid(), packed_);
      found.packed = packed_;
    } else if (!rules_->permit_all()) {
      join_masks();
      found.masks = joined_masks_;
    }
    if (any_set(forbidden_)) found.forbidden = forbidden_;
    return found;
  }

  /// Finds the masks of all classes, and in `members_` the cells where each class has an action.
  void find_ruled(const RowPosition& position, ConstRow cells) {
    std::vector<Word> all(cells.begin(), cells.end()), any(cells.size());
    for (std::size_t c = 0; c < masks_.size(); ++c) {
      const ClassRules& rules = rules_->classes[c];
      rules.asks_controller ? find_masks(position, c) : fill_masks(c, cells);
      std::fill(any.begin(), any.end(), 0);
      for (std::size_t g = 0; g < groups_.classes[c]->size(); ++g) {
        Word* const mask = masks_[c].data() + g * cells.size();
        for (std::size_t w = 0; w < cells.size(); ++w) mask[w] &= cells[w];
        for (const std::size_t t : rules.sources) keep(permitted(position, c, g, t), mask);
        for (std::size_t w = 0; w < cells.size(); ++w) any[w] |= mask[w];
      }
      if (rules_->without_action != nullptr) count_without_action(position, c, any, all);
      keep(any, all.data());
    }
    members_ = std::move(all);
  }

  static void keep(ConstRow cells, Word* set) {
    for (std::size_t w = 0; w < cells.size(); ++w) set[w] &= cells[w];
  }

  /// Counts the cells of `all` that are not in `any`: class c has no action there.
  void count_without_action(const RowPosition& position, std::size_t c, ConstRow any,
                            const std::vector<Word>& all) const {
    std::vector<Word> without_action(all);
    for (std::size_t w = 0; w < any.size(); ++w) without_action[w] &= ~any[w];
    const auto count = [&](std::size_t agent, const std::vector<Word>& cells) {
      for (std::size_t w = 0; w < cells.size(); ++w) {
        (*rules_->without_action)[agent] += std::popcount(cells[w] & without_action[w]);
        without_action[w] &= ~cells[w];
      }
    };
    if (!any_set(without_action)) return;
    const ClassRules& rules = rules_->classes[c];
    for (std::size_t k = 0; k < rules.sources.size(); ++k) {
      std::vector<Word> nothing(all.size(), ~Word{0});
      for (std::size_t g = 0; g < groups_.classes[c]->size(); ++g) {
        const ConstRow cells = permitted(position, c, g, rules.sources[k]);
        for (std::size_t w = 0; w < cells.size(); ++w) nothing[w] &= ~cells[w];
      }
      count(rules.agents[k], nothing);
    }
    count(rules.agent, std::vector<Word>(all.size(), ~Word{0}));
  }

  [[nodiscard]] ConstRow permitted(const RowPosition& position, std::size_t c, std::size_t g,
                                   std::size_t source) const {
    const std::uint32_t action = groups_.classes[c]->representative[g];
    return rules_->tables[source]->row(grouping_.sources()[source].base(position) +
                                       grouping_.contribution(c, source, action));
  }

  /// Adds the cells where an action of a class leads out through an unsafe side, which products of boxes do
  /// not show.
  void mark_blocked() {
    for (std::size_t c = 0; c < masks_.size(); ++c) {
      for (std::uint32_t g = 0; g < groups_.classes[c]->size(); ++g) {
        if (boxes_.kind(c, g) != RowBoxes::Kind::blocked) continue;
        const Word* const mask = masks_[c].data() + g * forbidden_.size();
        for (std::size_t w = 0; w < forbidden_.size(); ++w) forbidden_[w] |= mask[w];
      }
    }
  }

  void join_masks() {
    joined_masks_.clear();
    for (const std::vector<Word>& mask : masks_)
      joined_masks_.insert(joined_masks_.end(), mask.begin(), mask.end());
  }

  void fill_masks(std::size_t c, ConstRow invariant) {
    masks_[c].clear();
    for (std::size_t g = 0; g < groups_.classes[c]->size(); ++g) {
      masks_[c].insert(masks_[c].end(), invariant.begin(), invariant.end());
    }
  }

  /// Finds the masks of class c, larger posts first: where they are reasonable, those inside them are, too.
  void find_masks(const RowPosition& position, std::size_t c) {
    const ActionGroups& groups = *groups_.classes[c];
    masks_[c].assign(groups.size() * members_.size(), 0);
    known_.assign(groups.size(), 0);
    for (const std::uint32_t g : groups.maximal) find_mask(position, c, g);
    for (const std::uint32_t g : groups.all) {
      if (known_[g] == 0) find_mask(position, c, g);
    }
  }

  void find_mask(const RowPosition& position, std::size_t c, std::uint32_t g) {
    const ActionGroups& groups = *groups_.classes[c];
    const ConstRow invariant = controller_.invariant->row(position.row);
    const MutableRow mask(masks_[c].data() + g * members_.size(), members_.size());
    for (const std::uint32_t h : groups.maximal) {
      if (known_[h] == 0 || !groups.is_within(g, h)) continue;
      for (std::size_t w = 0; w < mask.size(); ++w) mask[w] |= masks_[c][h * mask.size() + w];
    }
    known_[g] = 1;
    find_reachable(c, g, invariant);
    if (is_subset(reachable_, mask)) return;
    // An action of class c is in the projection if some action of the others fits it; the minimal ones are
    // enough.
    choose_groups(groups_, GroupChoice::minimal, candidates_);
    candidates_[c] = {&g, 1};
    if (is_simple_) {
      add_boxes(0, position, mask);
      return;
    }
    tuple_.begin(grouping_, position, groups_, candidates_);
    LaneRange missing = missing_lanes(reachable_, mask);
    do {
      controller_row(controller_, levels_, position.row, tuple_, posts_, missing, members_);
      for (std::size_t w = 0; w < mask.size(); ++w) mask[w] |= members_[w];
      missing = missing_lanes(reachable_, mask);
    } while (missing.size() > 0 && tuple_.next());
  }

  /// Finds the cells of K from which group g by itself does not leave an unsafe end of the row: no other
  /// cells can be in the mask.
  void find_reachable(std::size_t c, std::uint32_t g, ConstRow invariant) {
    reachable_.assign(invariant.begin(), invariant.end());
    if (!is_simple_) return;
    const RowEngine& engine = *controller_.engine;
    left_.assign(reachable_.size(), 0);
    const RowFamily posts = engine.posts();
    for (std::size_t i = 0; i < boxes_.moved(c).size(); ++i) {
      const std::size_t t = boxes_.moved(c)[i];
      if (t >= engine.across()) mark_leaving(posts.shape, t - engine.across(), boxes_.ranges(c, g)[i], left_);
    }
    for (std::size_t w = 0; w < left_.size(); ++w) reachable_[w] &= ~left_[w];
  }

  /// Adds to `mask` the cells whose post is in K, for all candidates of class c and the classes after it.
  /// @returns false if no more cells can be found
  bool add_boxes(std::size_t c, const RowPosition& position, MutableRow mask) {
    const ConstRow invariant = controller_.invariant->row(position.row);
    if (c == candidates_.size()) {
      const auto n = static_cast<std::size_t>(controller_.engine->row_length());
      posts_.kernels().top_bits(posts_.minimum(box_), members_.data(), n);
      for (std::size_t w = 0; w < mask.size(); ++w) mask[w] |= members_[w] & invariant[w];
      return !is_subset(reachable_, mask);
    }
    for (const std::uint32_t g : candidates_[c]) {
      if (boxes_.kind(c, g) == RowBoxes::Kind::blocked) continue;
      boxes_.put(c, boxes_.ranges(c, g), box_);
      if (!add_boxes(c + 1, position, mask)) return false;
    }
    return true;
  }

  const Controller& controller_;
  const SilentRules* rules_;  ///< null: there are none
  const LevelRows<Level>& levels_;
  bool keeps_masks_;
  const ActionGrouping& grouping_;
  const ForbiddenChoices& choices_;
  ForbiddenChoices::Workspace work_;
  RowBoxes boxes_;
  PairProjection pair_;
  bool is_simple_ = false;  ///< all joint posts of the row are boxes, and all joint inputs are allowed
  IndependentPosts independent_;
  PostReader<Level> posts_;
  RowGroups groups_;
  TupleWalk::Candidates candidates_;
  TupleWalk tuple_;
  RowBox box_;
  std::vector<Word> members_;
  std::vector<Word> forbidden_;
  std::vector<std::vector<Word>> masks_;
  std::vector<std::uint8_t> known_;
  std::vector<Word> packed_;
  std::vector<Word> joined_masks_;
  std::vector<Word> reachable_;
  std::vector<Word> left_;
};

Projections::Projections(const Controller& controller, const ActionGrouping& grouping, ThreadTeam& team,
                         const EqualWork& equal, bool keeps_masks)
    : grouping_(&grouping), words_(controller.engine->row_words()), equal_(equal) {
  number_rows_of(*controller.invariant, equal.by_tables(), controller.engine->share(), team);
  find_all(controller, team, nullptr, keeps_masks);
}

Projections::Projections(const Controller& controller, const ActionGrouping& grouping, ThreadTeam& team,
                         const SilentRules& rules)
    : grouping_(&grouping), words_(controller.engine->row_words()) {
  number_rows_of(*rules.cells, {}, controller.engine->share(), team);
  find_all(controller, team, &rules, false);
}

void Projections::find_all(const Controller& controller, ThreadTeam& team, const SilentRules* rules,
                           bool keeps_masks) {
  equal_.numbers = &classes_;
  const RowEngine& engine = *controller.engine;
  stores_.resize(static_cast<std::size_t>(team.size()));
  const ForbiddenChoices choices(*grouping_, team, rules != nullptr);
  controller.levels->visit([&]<class Level>(const LevelRows<Level>& levels) {
    std::deque<Builder<Level>> builders;
    const PostReader<Level> posts(engine, levels);
    for (int w = 0; w < team.size(); ++w)
      builders.emplace_back(controller, *grouping_, choices, levels, posts, rules, keeps_masks);
    posts.for_each_local_row(team, [&](ThreadTeam::Range range, int worker) {
      Builder<Level>& builder = builders[static_cast<std::size_t>(worker)];
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        const std::uint32_t number = number_[static_cast<std::size_t>(position.row)];
        if (number == kNothing || rows_[number - 1] != position.row) continue;
        const Found projected = builder.project(position);
        Store& store = stores_[static_cast<std::size_t>(worker)];
        Found& found = found_[number - 1];
        found.is_full = projected.is_full;
        found.packed = store.keep(projected.packed);
        found.masks = store.keep(projected.masks);
        found.forbidden = store.keep(projected.forbidden);
      }
    });
  });
}

std::span<const Word> Projections::Store::keep(std::span<const Word> list) {
  if (list.empty()) return {};
  if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < list.size()) {
    const std::size_t next =
        blocks_.empty() ? kFirstBlock : std::min(2 * blocks_.back().capacity(), kMostBlock);
    blocks_.emplace_back().reserve(std::max(next, list.size()));
  }
  std::vector<Word>& block = blocks_.back();
  block.insert(block.end(), list.begin(), list.end());
  return std::span<const Word>(block).last(list.size());
}

/// Numbers the rows of K: equal rows get the number of the first of them.
void Projections::number_rows_of(const CellSet& invariant, const EqualWork& equal, const RowShare* share,
                                 ThreadTeam& team) {
  const RowShare::Range run = local_rows(share, invariant.rows());
  number_ = ZeroedArray<std::uint32_t>(static_cast<std::size_t>(invariant.rows()));
  const Tiles* const tiles = equal_.tiles;
  if (tiles != nullptr)
    classes_ = tiles->refined(*equal.numbers, number_rows(invariant, share, &team), &team);
  for_each_local_row(team, share, invariant.rows(), 1024, [&](ThreadTeam::Range range, int) {
    for (std::int64_t row = range.begin; row < range.end; ++row)
      if (has_cells(invariant, row)) number_[static_cast<std::size_t>(row)] = kFound;
  });
  const auto has = [&](std::int64_t row) { return number_[static_cast<std::size_t>(row)] != kNothing; };
  for_each_with_first(tiles, classes_, run, has, [&](std::int64_t row, std::int64_t first) {
    if (first == row) rows_.push_back(row);
    number_[static_cast<std::size_t>(row)] =
        first == row ? static_cast<std::uint32_t>(rows_.size()) : number_[static_cast<std::size_t>(first)];
  });
  found_ = ZeroedArray<Found>(rows_.size());
}

/// Whether projections of the row are needed.
bool Projections::has_cells(const CellSet& invariant, std::int64_t row) const {
  if (equal_.symmetry != nullptr && !equal_.symmetry->is_canonical(row)) return false;
  return any_set(invariant.row(row));
}

ConstRow Projections::mask(std::int64_t row, const RowGroups& groups, std::size_t c, std::uint32_t g) const {
  REQUIRES(!of(row).masks.empty());
  return {of(row).masks.data() + (group_offset(groups, c) + g) * words_, words_};
}

}  // namespace coordreq
