#include "answers/layers/leaving_cells.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "answers/invariance/answer.hpp"
#include "answers/layers/independent_actions.hpp"
#include "answers/one_cell/cell_members.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "base/index.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Words in which the cells near a side are remembered.
constexpr std::int64_t kMostWordsOfSide = std::int64_t{1} << 13;

bool is_safe(const GridDimension& dimension, bool above) {
  return traits(above ? dimension.above : dimension.below).is_only_safe();
}

/// The `safe` sides of a problem, and the cells from which some joint input leads out through one. These are
/// found once for all rows that agree in what the side depends on: most cells are near none.
///
/// Immutable once built, so safe to share between threads.
class SafeSides {
 public:
  explicit SafeSides(const AnalysisContext& context)
      : abstraction_(*context.abstraction), engine_(*context.engine), grid_(abstraction_.grid) {
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (is_safe(grid_[i], false) || is_safe(grid_[i], true)) add(i);
    }
  }

  [[nodiscard]] bool leaves(std::int64_t x, std::int64_t u) const {
    return std::any_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return leaves_by(side.dimension, x, u); });
  }

  /// result = the cells of a row, among the given ones, from which some joint input, in C(x) or not, leads
  /// out through a side.
  void find_near(const RowPlace& place, ConstRow cells, MutableRow result) const {
    std::fill(result.begin(), result.end(), 0);
    for (const Side& side : sides_) {
      if (side.near.empty()) {
        for_each_bit(cells, [&](std::int64_t lane) { mark_if_near(side, place.row, lane, result.data()); });
        continue;
      }
      const Word* const near = side.near.data() + choice(side, place) * side.words;
      for (std::size_t w = 0; w < result.size(); ++w) result[w] |= near[side.words == 1 ? 0 : w];
    }
    for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
  }

 private:
  struct Side {
    std::size_t dimension = 0;
    std::vector<std::int64_t> parts =
        {};  ///< numbers of joint inputs, one for each choice of the inputs on which it depends
    std::size_t words = 1;        ///< of a row; one if it depends on no dimension along rows: all or nothing
    std::vector<Word> near = {};  ///< [choice(), word]; empty: there are too many
  };

  void add(std::size_t i) {
    Side& side = sides_.emplace_back();
    side.dimension = i;
    const TransitionTable& table = abstraction_.tables[i];
    std::vector<std::int64_t> counts, strides;
    for (const std::int32_t j : table.inputs) {
      counts.push_back(abstraction_.inputs[at(j)].count());
      strides.push_back(abstraction_.inputs.stride(at(j)));
    }
    Odometer inputs(counts);
    do {
      std::int64_t part = 0;
      for (std::size_t k = 0; k < counts.size(); ++k) part += inputs.indices()[k] * strides[k];
      side.parts.push_back(part);
    } while (inputs.advance());
    const bool is_along = std::any_of(table.states.begin(), table.states.end(),
                                      [&](auto j) { return at(j) >= grid_.across(); });
    side.words = is_along ? engine_.row_words() : 1;
    const std::int64_t choices = engine_.slices()[i].size() / engine_.slices()[i].input_combinations;
    if (choices > kMostWordsOfSide / static_cast<std::int64_t>(side.words)) return;
    side.near.assign(at(choices) * side.words, 0);
    std::vector<bool> is_known(at(choices), false);
    const RowShare::Range own = own_rows(engine_.share(), engine_.rows());
    for (RowPlace place(grid_, own.begin); place.row < own.end; place.advance(grid_)) {
      const std::size_t number = choice(side, place);
      if (!is_known[number]) fill(side, is_along, place.row, side.near.data() + number * side.words);
      is_known[number] = true;
    }
  }

  void fill(const Side& side, bool is_along, std::int64_t row, Word* near) const {
    if (!is_along) {
      mark_if_near(side, row, 0, near);
      if (*near != 0) *near = ~Word{0};
      return;
    }
    const RowFamily posts = engine_.posts();
    posts.shape.for_each_run([&](std::int64_t begin, std::int64_t count) {
      for (std::int64_t lane = begin; lane < begin + count; ++lane) mark_if_near(side, row, lane, near);
    });
  }

  /// The number of the choice of states across rows on which the side depends.
  [[nodiscard]] std::size_t choice(const Side& side, const RowPlace& place) const {
    const RowSlices& slices = engine_.slices()[side.dimension];
    return at(slices.base(place) / slices.input_combinations);
  }

  void mark_if_near(const Side& side, std::int64_t row, std::int64_t lane, Word* near) const {
    const std::int64_t x = row * grid_.row_length() + lane;
    if (std::any_of(side.parts.begin(), side.parts.end(),
                    [&](std::int64_t part) { return leaves_by(side.dimension, x, part); }))
      near[lane / CellSet::kWordBits] |= Word{1} << (lane % CellSet::kWordBits);
  }

  [[nodiscard]] bool leaves_by(std::size_t i, std::int64_t x, std::int64_t u) const {
    const IndexRange raw = abstraction_.raw(i, x, u);
    return (raw.first < 0 && is_safe(grid_[i], false)) ||
           (raw.last >= grid_[i].count && is_safe(grid_[i], true));
  }

  const Abstraction& abstraction_;
  const RowEngine& engine_;
  const UniformGrid& grid_;
  std::vector<Side> sides_;
};

/// Looks for a joint input of C(x) that leaves through a `safe` side. One object a thread.
class LeavingInput {
 public:
  LeavingInput(const Answers& answers, const SafeSides& sides)
      : context_(answers.context),
        grid_(context_.abstraction->grid),
        invariant_(answers.get<Invariance>().invariant),
        sides_(sides),
        posts_(*context_.abstraction) {}

  /// @pre unchecked: x is in Z_F.
  bool is_at(std::int64_t x) {
    posts_.move_to(x);
    const std::int64_t all = context_.abstraction->inputs.count();
    // The joint input that left the last cell most often leaves this one, too.
    for (std::int64_t k = 0; k < all; ++k) {
      const std::int64_t u = (last_ + k) % all;
      if (!sides_.leaves(x, u) || !is_admissible(x, u)) continue;
      last_ = u;
      return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool is_admissible(std::int64_t x, std::int64_t u) {
    const PairTable* const allow = context_.pairs.admissible();
    const std::int64_t row = x / grid_.row_length(), column = x % grid_.row_length();
    if (allow != nullptr &&
        (allow->row(row, u)[at(column / CellSet::kWordBits)] >> (column % CellSet::kWordBits) & 1) == 0)
      return false;
    if (context_.spec.controller.synthesis == Synthesis::given) return true;
    const CellPost post = posts_.post(u, context_.tubes());
    if (post.blocked != CellPost::Blocked::no) return false;
    return post.all_left ||
           for_each_cell(grid_, post.box, [this](std::int64_t cell) { return invariant_.test(cell); });
  }

  const AnalysisContext& context_;
  const UniformGrid& grid_;
  const CellSet& invariant_;
  const SafeSides& sides_;
  CellPosts posts_;
  std::int64_t last_ = 0;
};

/// Removes the cells from which some joint input leaves, in the rows owned.
void take_out_leaving(const Answers& answers, ThreadTeam& team, CellSet& cells) {
  const AnalysisContext& context = answers.context;
  const SafeSides sides(context);
  std::vector<std::unique_ptr<LeavingInput>> inputs;
  for (int w = 0; w < team.size(); ++w) inputs.push_back(std::make_unique<LeavingInput>(answers, sides));
  const RowEngine& engine = *context.engine;
  for_each_own_row(team, engine.share(), engine.rows(), 16, [&](ThreadTeam::Range range, int worker) {
    LeavingInput& input = *inputs[at(worker)];
    std::vector<Word> near(engine.row_words());
    for (RowPlace place(engine.grid(), range.begin); place.row < range.end; place.advance(engine.grid())) {
      const MutableRow row = cells.row(place.row);
      if (!any_set(row)) continue;
      sides.find_near(place, row, near);
      for_each_bit(near, [&](std::int64_t lane) {
        const std::int64_t x = place.row * engine.row_length() + lane;
        if ((context.over && context.over->test(x)) || !input.is_at(x)) return;
        row[at(lane / CellSet::kWordBits)] &= ~(Word{1} << (lane % CellSet::kWordBits));
      });
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

std::int64_t count_leaving_cells(const Answers& answers, const Projections& projections,
                                 const DelayLayers& layers, const WaveWatch& watch, ThreadTeam& team) {
  const AnalysisContext& context = answers.context;
  CellSet cells = layers.layers_of.top_cells(team);
  take_out_leaving(answers, team, cells);
  const CellSet& invariant = answers.get<Invariance>().invariant;
  const auto make = [&]<class Level>(Level) -> std::unique_ptr<RowOperator<Level>> {
    return std::make_unique<IndependentActions<Level>>(projections, invariant, team.size());
  };
  const LevelProblem problem{.spared = context.over_or_null(),
                             .equal = projections.equal_work(),
                             .make8 = [&] { return make(std::uint8_t{}); },
                             .make16 = [&] { return make(std::uint16_t{}); },
                             .make32 = [&] { return make(std::uint32_t{}); }};
  LevelMap start = first_levels(*context.engine, cells, problem.equal.tiles != nullptr, team);
  WaveCounts counts;
  const LevelMap steps = find_levels(*context.engine, *context.hull, problem,
                                     {.step = watch.step, .resumed = &start}, team, counts);
  return layers.sizes.back() - steps.histogram(team).top;
}

}  // namespace coordreq
