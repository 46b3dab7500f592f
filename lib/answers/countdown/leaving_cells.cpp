#include "answers/countdown/leaving_cells.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "answers/countdown/safe_sides.hpp"
#include "answers/invariance/answer.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "choices/independent_actions.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"
#include "engine/post_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// ids = the numbers of the slices of a row under a joint input.
void find_slices(const RowEngine& engine, const RowPosition& position, std::int64_t u,
                 std::vector<std::uint32_t>& ids) {
  const InputSpace& inputs = engine.abstraction().inputs;
  ids.clear();
  for (const RowSlices& slices : engine.slices()) {
    std::int64_t entry = slices.base(position);
    for (const std::int32_t j : slices.inputs) entry += inputs.index(u, at(j)) * slices.input_stride[at(j)];
    ids.push_back(slices.number(entry));
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
  /// @param posts a reader of the levels of the controller, of which this object takes a copy
  LeavingRows(const Answers& answers, const Projections& projections, const SafeSides& sides,
              const PostReader<Level>& posts)
      : context_(answers.context),
        controller_(answers.get<NonterminalController>().controller),
        engine_(*context_.engine),
        projections_(projections),
        sides_(sides),
        posts_(posts),
        pending_(engine_.row_words()),
        near_(engine_.row_words()),
        leaving_(engine_.row_words()) {}

  /// Takes the cells out of the row from which some joint input of C(x) leaves.
  /// @param outward takes the cells, of those in question, with the outward joint input in C(x)
  void take_out(const RowPosition& position, MutableRow row, MutableRow outward) {
    std::copy(row.begin(), row.end(), pending_.begin());
    if (context_.terminal) remove(context_.terminal->row(position.row), pending_);
    const bool full = is_full(position.row);
    if (full) {
      std::copy(pending_.begin(), pending_.end(), outward.begin());
    } else {
      posts_.enter(position.row);
      keep_members(position, sides_.outward(), pending_, outward);
    }
    sides_.find_near(position, pending_, near_);
    if (!any_set(near_)) return;
    ++rows_;
    if (!full) keep_admissible(position, outward);
    remove(near_, row);
    for (const Word word : near_) removed_ += word == 0 ? 0 : std::popcount(word);
  }

  /// Whether the outward joint input is in C(x) and leads ahead, for all of these unbounded cells of the row,
  /// which are not ahead by all joint inputs.
  [[nodiscard]] bool lead_ahead(const RowPosition& position, ConstRow cells) {
    ++rows_;
    if (!sides_.outward_leads_ahead(position, cells)) return false;
    if (is_full(position.row)) return true;
    posts_.enter(position.row);
    keep_members(position, sides_.outward(), cells, members_);
    return std::ranges::equal(members_, cells);
  }

  /// Rows with cells near a side, and rows of posts that were read.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t reads() const { return reads_; }
  /// Cells that were taken out.
  [[nodiscard]] std::int64_t removed() const { return removed_; }

 private:
  /// Every joint input is in C(x), at all x of K in the row.
  [[nodiscard]] bool is_full(std::int64_t row) const {
    const RowSymmetry* const symmetry = projections_.equal_work().symmetry;
    return projections_.is_full(symmetry == nullptr ? row : symmetry->canonical_of(row));
  }

  /// Keeps of near_ the cells from which a joint input of C(x) leaves.
  void keep_admissible(const RowPosition& position, ConstRow outward) {
    std::copy(near_.begin(), near_.end(), pending_.begin());
    sides_.find_leaving_outward(position, pending_, leaving_);
    for (std::size_t w = 0; w < pending_.size(); ++w) pending_[w] &= ~(leaving_[w] & outward[w]);
    members_of_.clear();
    for (std::size_t side = 0; side < sides_.size() && any_set(pending_); ++side) {
      for (std::size_t choice = sides_.input_choices(side); choice-- > 0 && any_set(pending_);) {
        sides_.find_leaving(side, choice, position, pending_, leaving_);
        if (!any_set(leaving_)) continue;
        sides_.for_each_input(side, choice, [&](std::int64_t u) {
          if (u == sides_.outward()) return true;  // from none of these
          keep_members(position, u, leaving_, members_);
          remove(members_, pending_);
          remove(members_, leaving_);
          return any_set(leaving_);
        });
      }
    }
    remove(pending_, near_);
  }

  /// result = these cells of the row, where u is in C(x).
  void keep_members(const RowPosition& position, std::int64_t u, ConstRow cells, MutableRow result) {
    std::copy(cells.begin(), cells.end(), result.begin());
    if (const PairTable* const allow = context_.pairs.admissible(); allow != nullptr) {
      const ConstRow allowed = allow->row(position.row, u);
      for (std::size_t w = 0; w < result.size(); ++w) result[w] &= allowed[w];
    }
    if (controller_.synthesis == Synthesis::maximal && any_set(result)) {
      const std::vector<Word>& kept = staying(position, u);
      for (std::size_t w = 0; w < result.size(); ++w) result[w] &= kept[w];
    }
  }

  /// The cells of the row whose post under u lies in K; of other joint inputs than the outward one found once
  /// for all with the same posts.
  const std::vector<Word>& staying(const RowPosition& position, std::int64_t u) {
    find_slices(engine_, position, u, ids_);
    if (u == sides_.outward()) return read(staying_);
    const auto [found, is_new] = members_of_.try_emplace(ids_);
    if (!is_new) return found->second;
    found->second.resize(near_.size());
    return read(found->second);
  }

  /// result = those cells, of ids_.
  const std::vector<Word>& read(std::vector<Word>& result) {
    ++reads_;
    const LaneRange lanes = engine_.all_lanes();
    posts_.kernels().top_bits(posts_.minimum(ids_, lanes, 0), result.data(), lanes.size());
    return result;
  }

  const AnalysisContext& context_;
  const Controller& controller_;
  const RowEngine& engine_;
  const Projections& projections_;
  const SafeSides& sides_;
  PostReader<Level> posts_;
  std::vector<Word> pending_;
  std::vector<Word> near_;
  std::vector<Word> leaving_;
  std::vector<Word> members_ = std::vector<Word>(near_.size());
  std::vector<Word> staying_ = std::vector<Word>(near_.size());
  std::map<std::vector<std::uint32_t>, std::vector<Word>> members_of_;  ///< by the numbers of the slices
  std::vector<std::uint32_t> ids_;
  std::int64_t rows_ = 0;
  std::int64_t reads_ = 0;
  std::int64_t removed_ = 0;
};

/// Calls `visit(workers)` with a LeavingRows for each thread.
template <class Visit>
void with_workers(const Answers& answers, const Projections& projections, const SafeSides& sides,
                  ThreadTeam& team, const Visit& visit) {
  answers.get<NonterminalController>().controller.levels->visit(
      [&]<class Level>(const LevelRows<Level>& levels) {
        std::deque<LeavingRows<Level>> workers;
        const PostReader<Level> posts(*answers.context.engine, levels);
        for (int w = 0; w < team.size(); ++w) workers.emplace_back(answers, projections, sides, posts);
        visit(workers);
      });
}

/// The unbounded cells of a row. @pre rows are along one dimension
void find_unbounded(const LevelMap& layers_of, std::int64_t row, MutableRow result) {
  layers_of.visit([&]<class Level>(const LevelRows<Level>& levels) {
    REQUIRES(levels.shape().dimensions.size() == 1);
    level_kernels<Level>(best_instruction_set())
        .top_bits(levels.row(row), result.data(), at(levels.row_length()));
  });
}

/// True if each unbounded cell has a joint input in C(x) that leads out or to a cell that is further outward.
/// Then all of them leave: of the cells of Y those that are furthest outward would have such a joint input,
/// but it leads to no other cell of Y. In C(x) there is some joint input, so that in most cells nothing needs
/// to be known but the tables of the sides.
/// @returns false also where that is not known
bool all_lead_ahead(const Answers& answers, const Projections& projections, const DelayLayers& layers,
                    const SafeSides& sides, ThreadTeam& team, LeavingCounts& counts) {
  const AnalysisContext& context = answers.context;
  const RowEngine& engine = *context.engine;
  const bool may_be_empty = answers.get<NonterminalController>().controller.synthesis != Synthesis::maximal &&
                            context.pairs.admissible() != nullptr;
  if (context.terminal || may_be_empty || engine.along() != 1 || !sides.knows_ahead()) return false;
  std::atomic<bool> all = true;
  LeavingCounts local;
  with_workers(answers, projections, sides, team, [&](auto& workers) {
    std::vector<Word> every(engine.row_words());
    set_bits(every, 0, engine.row_length());
    for_each_local_row(team, engine.share(), engine.rows(), 64, [&](ThreadTeam::Range range, int worker) {
      std::vector<Word> ahead(every.size()), open(every.size());
      for (RowPosition position(engine.grid(), range.begin); all && position.row < range.end;
           position.advance(engine.grid())) {
        sides.find_ahead(position, every, ahead);
        if (ahead == every) continue;
        find_unbounded(layers.layers_of, position.row, open);
        remove(ahead, open);
        if (any_set(open) && !workers[at(worker)].lead_ahead(position, open)) all = false;
      }
    });
    for (const auto& worker : workers) {
      local.rows_near += worker.rows();
      local.rows_read += worker.reads();
    }
  });
  if (sum_of_all(engine.share(), all ? 0 : 1) > 0) return false;
  counts.cells = layers.sizes.back();
  counts.rows_near = sum_of_all(engine.share(), local.rows_near);
  counts.rows_read = sum_of_all(engine.share(), local.rows_read);
  return true;
}

/// Takes the cells out from which some joint input leaves, in the rows owned.
/// @param outward takes the cells with the outward joint input in C(x)
void take_out_leaving(const Answers& answers, const Projections& projections, const SafeSides& sides,
                      ThreadTeam& team, CellSet& cells, CellSet& outward, LeavingCounts& counts) {
  const RowEngine& engine = *answers.context.engine;
  with_workers(answers, projections, sides, team, [&](auto& workers) {
    for_each_local_row(team, engine.share(), engine.rows(), 16, [&](ThreadTeam::Range range, int worker) {
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        if (any_set(cells.row(position.row)))
          workers[at(worker)].take_out(position, cells.row(position.row), outward.row(position.row));
      }
    });
    for (const auto& worker : workers) {
      counts.rows_near += worker.rows();
      counts.rows_read += worker.reads();
      counts.cells += worker.removed();
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
  LeavingCounts counts;
  SafeSides sides(context);
  if (all_lead_ahead(answers, projections, layers, sides, team, counts)) return counts;
  sides.make_ready(team);
  const CellSet all = layers.layers_of.top_cells(team);
  const std::int64_t unbounded = layers.sizes.back();
  CellSet cells = all;
  {
    CellSet outward(engine.rows(), engine.row_length());
    take_out_leaving(answers, projections, sides, team, cells, outward, counts);
    // Where no joint input leaves, or nothing is left, there is nothing to spread.
    const std::int64_t removed = sum_of_all(engine.share(), counts.cells);
    if (removed > 0 && removed < unbounded - context.terminal_cells)
      counts.cells += take_out_runs(context, sides, all, outward, team, cells);
  }
  for (std::int64_t* number : {&counts.cells, &counts.rows_near, &counts.rows_read})
    *number = sum_of_all(engine.share(), *number);
  if (counts.cells == 0 || counts.cells == unbounded - context.terminal_cells) return counts;
  const CellSet& invariant = answers.get<Invariance>().invariant;
  const auto make = [&]<class Level>(Level) -> std::unique_ptr<RowOperator<Level>> {
    return std::make_unique<IndependentActions<Level>>(projections, invariant, team.size(),
                                                       IndependentActions<Level>::LostLevels::flag);
  };
  const LevelProblem problem{.spared = context.terminal_or_null(),
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
