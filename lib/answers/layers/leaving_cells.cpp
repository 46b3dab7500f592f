#include "answers/layers/leaving_cells.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "answers/invariance/answer.hpp"
#include "answers/layers/independent_actions.hpp"
#include "answers/layers/outward_runs.hpp"
#include "answers/layers/safe_sides.hpp"
#include "base/index.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"
#include "engine/post_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// ids = the numbers of the slices of a row under a joint input.
void find_slices(const RowEngine& engine, const RowPlace& place, std::int64_t u,
                 std::vector<std::uint32_t>& ids) {
  const InputSpace& inputs = engine.abstraction().inputs;
  ids.clear();
  for (const RowSlices& slices : engine.slices()) {
    std::int64_t position = slices.base(place);
    for (const std::int32_t j : slices.inputs)
      position += inputs.index(u, at(j)) * slices.input_stride[at(j)];
    ids.push_back(slices.number(position));
  }
}

void remove(ConstRow cells, MutableRow set) {
  for (std::size_t w = 0; w < set.size(); ++w) set[w] &= ~cells[w];
}

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
        leaving_(engine_.row_words()) {}

  /// Takes the cells out of the row from which some joint input of C(x) leaves.
  /// @param outward takes the cells, of those asked about, with the outward joint input in C(x)
  void take_out(const RowPlace& place, MutableRow row, MutableRow outward) {
    std::copy(row.begin(), row.end(), asked_.begin());
    if (context_.over) remove(context_.over->row(place.row), asked_);
    const bool full = is_full(place.row);
    members_of_.clear();
    if (full) {
      std::copy(asked_.begin(), asked_.end(), outward.begin());
    } else {
      enter(place);
      keep_members(place, sides_.outward(), asked_, outward);
    }
    sides_.find_near(place, asked_, near_);
    if (!any_set(near_)) return;
    ++rows_;
    if (!full) keep_admissible(place, outward);
    remove(near_, row);
  }

  /// Rows with cells near a side, and rows of posts that were read.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t reads() const { return reads_; }

 private:
  /// Every joint input is in C(x), at all x of K in the row.
  [[nodiscard]] bool is_full(std::int64_t row) const {
    const RowSymmetry* const symmetry = projections_.equal_work().symmetry;
    return projections_.is_full(symmetry == nullptr ? row : symmetry->canonical_of(row));
  }

  void enter(const RowPlace& place) {
    const std::int64_t unit = place.row / engine_.unit_rows();
    if (unit != unit_) posts_.enter();
    unit_ = unit;
  }

  /// Keeps of near_ the cells from which a joint input of C(x) leaves.
  void keep_admissible(const RowPlace& place, ConstRow outward) {
    asked_ = near_;
    sides_.find_leaving_outward(place, asked_, leaving_);
    for (std::size_t w = 0; w < asked_.size(); ++w) asked_[w] &= ~(leaving_[w] & outward[w]);
    for (std::size_t side = 0; side < sides_.size() && any_set(asked_); ++side) {
      for (std::size_t part = sides_.parts(side); part-- > 0 && any_set(asked_);) {
        sides_.find_leaving(side, part, place, asked_, leaving_);
        if (!any_set(leaving_)) continue;
        sides_.for_each_input(side, part, [&](std::int64_t u) {
          keep_members(place, u, leaving_, members_);
          remove(members_, asked_);
          remove(members_, leaving_);
          return any_set(leaving_);
        });
      }
    }
    remove(asked_, near_);
  }

  /// result = these cells of the row, where u is in C(x).
  void keep_members(const RowPlace& place, std::int64_t u, ConstRow cells, MutableRow result) {
    std::copy(cells.begin(), cells.end(), result.begin());
    if (const PairTable* const allow = context_.pairs.admissible(); allow != nullptr) {
      const ConstRow allowed = allow->row(place.row, u);
      for (std::size_t w = 0; w < result.size(); ++w) result[w] &= allowed[w];
    }
    if (controller_.synthesis == Synthesis::maximal && any_set(result)) {
      const std::vector<Word>& kept = staying(place, u);
      for (std::size_t w = 0; w < result.size(); ++w) result[w] &= kept[w];
    }
  }

  /// The cells of the row whose post under u lies in K, found once for all joint inputs with the same posts.
  const std::vector<Word>& staying(const RowPlace& place, std::int64_t u) {
    find_slices(engine_, place, u, ids_);
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
  std::vector<Word> members_ = std::vector<Word>(near_.size());
  std::map<std::vector<std::uint32_t>, std::vector<Word>> members_of_;  ///< by the numbers of the slices
  std::vector<std::uint32_t> ids_;
  std::int64_t unit_ = -1;  ///< that the reader was entered for
  std::int64_t rows_ = 0;
  std::int64_t reads_ = 0;
};

/// Takes the cells out from which some joint input leaves, in the rows owned.
/// @param outward takes the cells with the outward joint input in C(x)
void take_out_leaving(const Answers& answers, const Projections& projections, const SafeSides& sides,
                      ThreadTeam& team, CellSet& cells, CellSet& outward, LeavingCounts& counts) {
  const RowEngine& engine = *answers.context.engine;
  answers.get<GoingOn>().controller.levels->visit([&]<class Level>(const LevelRows<Level>& levels) {
    std::deque<LeavingRows<Level>> workers;
    for (int w = 0; w < team.size(); ++w) workers.emplace_back(answers, projections, sides, levels);
    for_each_own_row(team, engine.share(), engine.rows(), 16, [&](ThreadTeam::Range range, int worker) {
      for (RowPlace place(engine.grid(), range.begin); place.row < range.end; place.advance(engine.grid())) {
        if (any_set(cells.row(place.row)))
          workers[at(worker)].take_out(place, cells.row(place.row), outward.row(place.row));
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
  const CellSet all = layers.layers_of.top_cells(team);
  const std::int64_t unbounded = layers.sizes.back();
  CellSet cells = all;
  const SafeSides sides(context, team);
  {
    CellSet outward(engine.rows(), engine.row_length());
    take_out_leaving(answers, projections, sides, team, cells, outward, counts);
    counts.cells = unbounded - count(cells);
    // Where no joint input leaves, or nothing is left, there is nothing to spread.
    if (counts.cells > 0 && counts.cells < unbounded - context.over_cells)
      counts.cells += sum_of_all(engine.share(), take_out_runs(context, sides, all, outward, team, cells));
  }
  for (std::int64_t* rows : {&counts.rows_near, &counts.rows_read}) *rows = sum_of_all(engine.share(), *rows);
  if (counts.cells == 0 || counts.cells == unbounded - context.over_cells) return counts;
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
