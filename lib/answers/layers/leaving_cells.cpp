#include "answers/layers/leaving_cells.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "answers/invariance/answer.hpp"
#include "answers/layers/independent_actions.hpp"
#include "answers/layers/safe_sides.hpp"
#include "base/index.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"
#include "engine/post_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Looks for joint inputs of C(x) that leave through a `safe` side, for a row of cells of Z_F at once. There
/// C(x) = IND_C(x), see count_leaving_cells(). One object a thread.
template <class Level>
class LeavingRows {
 public:
  /// @param levels those of the controller
  LeavingRows(const Answers& answers, const Projections& projections, const SafeSides& sides,
              const LevelRows<Level>& levels)
      : context_(answers.context),
        controller_(answers.get<GoingOn>().controller),
        engine_(*context_.engine),
        projections_(projections),
        sides_(sides),
        posts_(engine_, levels),
        asked_(engine_.row_words()),
        near_(engine_.row_words()),
        leaving_(engine_.row_words()),
        members_(engine_.row_words()) {
    std::size_t parts = 0;
    for (std::size_t side = 0; side < sides.size(); ++side) {
      first_part_.push_back(parts);
      parts += sides.parts(side);
    }
    is_known_.resize(parts);
    by_part_.resize(parts * engine_.row_words());
  }

  /// Takes the cells out of the row from which some joint input of C(x) leaves.
  void take_out(const RowPlace& place, MutableRow row) {
    std::copy(row.begin(), row.end(), asked_.begin());
    if (context_.over) remove(context_.over->row(place.row), asked_);
    sides_.find_near(place, asked_, near_);
    if (!any_set(near_)) return;
    ++rows_;
    if (!is_full(place.row)) keep_admissible(place);
    remove(near_, row);
  }

  /// Rows with cells near a side, and rows of posts that were read for them.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t reads() const { return reads_; }

 private:
  static void remove(ConstRow cells, MutableRow set) {
    for (std::size_t w = 0; w < set.size(); ++w) set[w] &= ~cells[w];
  }

  /// Every joint input is in C(x), at all x of K in the row.
  [[nodiscard]] bool is_full(std::int64_t row) const {
    const RowSymmetry* const symmetry = projections_.equal_work().symmetry;
    return projections_.is_full(symmetry == nullptr ? row : symmetry->canonical_of(row));
  }

  /// Keeps of near_ the cells from which a joint input of C(x) leaves.
  void keep_admissible(const RowPlace& place) {
    std::fill(is_known_.begin(), is_known_.end(), 0);
    members_of_.clear();
    const std::int64_t unit = place.row / engine_.unit_rows();
    if (unit != unit_) posts_.enter();
    unit_ = unit;
    asked_ = near_;
    std::int64_t u = 0;
    const std::int64_t all = context_.abstraction->inputs.count();
    for (; u < all && any_set(asked_); ++u) {
      if (find_leaving(place, u)) remove(admissible(place, u), asked_);
    }
    remove(asked_, near_);
  }

  /// leaving_ = the cells asked about from which joint input u, if it is allowed there, leaves. @returns
  /// whether there are some
  bool find_leaving(const RowPlace& place, std::int64_t u) {
    std::fill(leaving_.begin(), leaving_.end(), 0);
    for (std::size_t side = 0; side < sides_.size(); ++side) {
      const std::size_t part = sides_.part_of(side, u), number = first_part_[side] + part;
      const MutableRow cells(by_part_.data() + number * near_.size(), near_.size());
      if (is_known_[number] == 0) sides_.find_leaving(side, part, place, near_, cells);
      is_known_[number] = 1;
      for (std::size_t w = 0; w < leaving_.size(); ++w) leaving_[w] |= cells[w] & asked_[w];
    }
    if (const PairTable* const allow = context_.pairs.admissible(); allow != nullptr && any_set(leaving_)) {
      const ConstRow allowed = allow->row(place.row, u);
      for (std::size_t w = 0; w < leaving_.size(); ++w) leaving_[w] &= allowed[w];
    }
    return any_set(leaving_);
  }

  /// The cells of leaving_ with u in C(x).
  ConstRow admissible(const RowPlace& place, std::int64_t u) {
    std::copy(leaving_.begin(), leaving_.end(), members_.begin());
    if (controller_.synthesis == Synthesis::maximal) {
      const std::vector<Word>& kept = staying(place, u);
      for (std::size_t w = 0; w < members_.size(); ++w) members_[w] &= kept[w];
    }
    return members_;
  }

  /// The cells of the row whose post under u lies in K, found once for all joint inputs with the same posts.
  const std::vector<Word>& staying(const RowPlace& place, std::int64_t u) {
    ids_.clear();
    for (const RowSlices& slices : engine_.slices()) {
      std::int64_t position = slices.base(place);
      for (const std::int32_t j : slices.inputs)
        position += context_.abstraction->inputs.index(u, at(j)) * slices.input_stride[at(j)];
      ids_.push_back(slices.number(position));
    }
    const auto [found, is_new] = members_of_.try_emplace(ids_);
    if (!is_new) return found->second;
    ++reads_;
    found->second.resize(near_.size());
    const LaneRange lanes = engine_.all_lanes();
    posts_.kernels().top_bits(posts_.minimum(ids_, lanes, 0), found->second.data(), lanes.size());
    return found->second;
  }

  const AnalysisContext& context_;
  const Controller& controller_;
  const RowEngine& engine_;
  const Projections& projections_;
  const SafeSides& sides_;
  PostReader<Level> posts_;
  std::vector<Word> asked_;
  std::vector<Word> near_;
  std::vector<Word> leaving_;
  std::vector<Word> members_;
  std::vector<std::size_t> first_part_;  ///< [side] number of its first part among those of all sides
  std::vector<std::uint8_t> is_known_;   ///< [part] whether its leaving cells are known in this row
  std::vector<Word> by_part_;            ///< [part * words] these cells
  std::map<std::vector<std::uint32_t>, std::vector<Word>> members_of_;  ///< by the numbers of the slices
  std::vector<std::uint32_t> ids_;
  std::int64_t unit_ = -1;  ///< that the reader was entered for
  std::int64_t rows_ = 0;
  std::int64_t reads_ = 0;
};

/// Takes the cells out from which some joint input leaves, in the rows owned.
void take_out_leaving(const Answers& answers, const Projections& projections, ThreadTeam& team,
                      CellSet& cells, LeavingCounts& counts) {
  const RowEngine& engine = *answers.context.engine;
  const SafeSides sides(answers.context, cells, team);
  answers.get<GoingOn>().controller.levels->visit([&]<class Level>(const LevelRows<Level>& levels) {
    std::deque<LeavingRows<Level>> workers;
    for (int w = 0; w < team.size(); ++w) workers.emplace_back(answers, projections, sides, levels);
    for_each_own_row(team, engine.share(), engine.rows(), 16, [&](ThreadTeam::Range range, int worker) {
      for (RowPlace place(engine.grid(), range.begin); place.row < range.end; place.advance(engine.grid())) {
        if (any_set(cells.row(place.row))) workers[at(worker)].take_out(place, cells.row(place.row));
      }
    });
    for (const LeavingRows<Level>& worker : workers) {
      counts.rows_near += worker.rows();
      counts.rows_read += worker.reads();
    }
  });
}

/// The greatest level for the cells of a set, which is known in the rows owned; 0 for others.
LevelMap first_levels(const RowEngine& engine, const CellSet& cells, bool shared, ThreadTeam& team) {
  auto levels = engine.make_levels<std::uint8_t>(cells, team, shared);
  if (engine.share() != nullptr) {
    LevelMessages<std::uint8_t>(levels).exchange(
        [](std::int64_t) { return true; },
        [&levels](std::int64_t row, const std::uint8_t* others) { levels.put(row, others); });
  }
  return LevelMap(std::move(levels));
}

}  // namespace

bool has_safe_side(const ProblemSpec& spec) {
  return std::any_of(spec.states.begin(), spec.states.end(), [](const StateSpec& state) {
    return traits(state.below).is_only_safe() || traits(state.above).is_only_safe();
  });
}

LeavingCounts count_leaving_cells(const Answers& answers, const Projections& projections,
                                  const DelayLayers& layers, const WaveWatch& watch, ThreadTeam& team) {
  const AnalysisContext& context = answers.context;
  const RowEngine& engine = *context.engine;
  const auto count = [&](const CellSet& set) {
    const RowShare::Range own = own_rows(engine.share(), set.rows());
    return sum_of_all(engine.share(), set.count(own.begin, own.end));
  };
  LeavingCounts counts;
  CellSet cells = layers.layers_of.top_cells(team);
  const std::int64_t unbounded = layers.sizes.back();
  take_out_leaving(answers, projections, team, cells, counts);
  for (std::int64_t* rows : {&counts.rows_near, &counts.rows_read}) *rows = sum_of_all(engine.share(), *rows);
  const std::int64_t staying = count(cells);
  counts.cells = unbounded - staying;
  // Where no joint input leaves, or nothing is left, there is nothing to spread.
  if (counts.cells == 0 || staying == context.over_cells) return counts;
  const CellSet& invariant = answers.get<Invariance>().invariant;
  const auto make = [&]<class Level>(Level) -> std::unique_ptr<RowOperator<Level>> {
    return std::make_unique<IndependentActions<Level>>(projections, invariant, team.size(),
                                                       IndependentActions<Level>::Tells::whether);
  };
  const LevelProblem problem{.spared = context.over_or_null(),
                             .equal = projections.equal_work(),
                             .limit = 1,
                             .make8 = [&] { return make(std::uint8_t{}); },
                             .make16 = [&] { return make(std::uint16_t{}); },
                             .make32 = [&] { return make(std::uint32_t{}); }};
  LevelMap start = first_levels(engine, cells, problem.equal.tiles != nullptr, team);
  const LevelMap steps =
      find_levels(engine, *context.hull, problem, {.step = watch.step, .resumed = &start}, team, counts.wave);
  counts.cells = unbounded - steps.histogram(team).top;
  return counts;
}

}  // namespace coordreq
