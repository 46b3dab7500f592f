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

/// Words in which one thread remembers the cells near a side.
constexpr std::int64_t kMostWordsOfSide = std::int64_t{1} << 13;

bool is_safe(const GridDimension& dimension, bool above) {
  return traits(above ? dimension.above : dimension.below).is_only_safe();
}

/// Looks for a joint input of C(x) that leaves through a `safe` side. One object a thread.
class LeavingInput {
 public:
  explicit LeavingInput(const Answers& answers)
      : context_(answers.context),
        abstraction_(*context_.abstraction),
        grid_(abstraction_.grid),
        invariant_(answers.get<Invariance>().invariant),
        posts_(abstraction_),
        near_(answers.context.engine->row_words()) {
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (!is_safe(grid_[i], false) && !is_safe(grid_[i], true)) continue;
      Side& side = sides_.emplace_back();
      side.dimension = i;
      std::int64_t keys = 1;
      for (const std::int32_t j : abstraction_.tables[i].states) {
        side.is_along = side.is_along || at(j) >= grid_.across();
        if (at(j) >= grid_.across()) continue;
        side.across.push_back(at(j));
        side.strides.push_back(keys);
        keys *= grid_[at(j)].count;
      }
      side.words = side.is_along ? near_.size() : 1;
      if (keys <= kMostWordsOfSide / static_cast<std::int64_t>(side.words)) {
        side.known.assign(at(keys) * side.words, 0);
        side.is_known.assign(at(keys), false);
      }
      std::vector<std::int64_t> counts, strides;
      for (const std::int32_t j : abstraction_.tables[i].inputs) {
        counts.push_back(abstraction_.inputs[at(j)].count());
        strides.push_back(abstraction_.inputs.stride(at(j)));
      }
      Odometer choice(counts);
      do {
        std::int64_t part = 0;
        for (std::size_t k = 0; k < counts.size(); ++k) part += choice.indices()[k] * strides[k];
        side.parts.push_back(part);
      } while (choice.advance());
    }
  }

  /// Leaves in a row of cells those from which some joint input, in C(x) or not, leads out through a `safe`
  /// side.
  void keep_near(std::int64_t row, MutableRow cells) {
    std::fill(near_.begin(), near_.end(), 0);
    for (Side& side : sides_) add_near(side, row, cells);
    for (std::size_t w = 0; w < near_.size(); ++w) cells[w] &= near_[w];
  }

  /// @pre unchecked: x is in Z_F.
  bool is_at(std::int64_t x) {
    posts_.move_to(x);
    const std::int64_t all = abstraction_.inputs.count();
    // The joint input that left the last cell most often leaves this one, too.
    for (std::int64_t k = 0; k < all; ++k) {
      const std::int64_t u = (last_ + k) % all;
      if (!leaves(x, u) || !is_admissible(x, u)) continue;
      last_ = u;
      return true;
    }
    return false;
  }

 private:
  struct Side {
    std::size_t dimension;
    std::vector<std::int64_t>
        parts;  ///< numbers of joint inputs, one for each choice of the inputs on which the side depends
    /// The dimensions across rows on which it depends: rows that agree in them have the same cells near it.
    std::vector<std::size_t> across;
    std::vector<std::int64_t> strides;
    bool is_along = false;    ///< it depends on a dimension along rows, too
    std::size_t words = 1;    ///< of such a row; one if it is all or nothing
    std::vector<Word> known;  ///< [choice of their indices * words + word]; empty: there are too many
    std::vector<bool> is_known;
  };

  void add_near(Side& side, std::int64_t row, ConstRow cells) {
    const std::int64_t first = row * grid_.row_length();
    if (side.known.empty()) {
      for_each_bit(cells, [&](std::int64_t lane) {
        if (is_near(side, first + lane))
          near_[at(lane / CellSet::kWordBits)] |= Word{1} << (lane % CellSet::kWordBits);
      });
      return;
    }
    std::int64_t key = 0;
    for (std::size_t k = 0; k < side.across.size(); ++k)
      key += grid_.index(first, side.across[k]) * side.strides[k];
    Word* const known = side.known.data() + at(key) * side.words;
    if (!side.is_known[at(key)]) {
      side.is_known[at(key)] = true;
      if (side.is_along) {
        const RowFamily posts = context_.engine->posts();
        posts.shape.for_each_run([&](std::int64_t begin, std::int64_t count) {
          for (std::int64_t lane = begin; lane < begin + count; ++lane) {
            if (is_near(side, first + lane))
              known[lane / CellSet::kWordBits] |= Word{1} << (lane % CellSet::kWordBits);
          }
        });
      } else if (is_near(side, first)) {
        known[0] = ~Word{0};
      }
    }
    for (std::size_t w = 0; w < near_.size(); ++w) near_[w] |= known[side.is_along ? w : 0];
  }

  /// Whether some joint input, in C(x) or not, leads out through the side.
  [[nodiscard]] bool is_near(const Side& side, std::int64_t x) const {
    return std::any_of(side.parts.begin(), side.parts.end(),
                       [&](std::int64_t part) { return leaves_by(side.dimension, x, part); });
  }

  [[nodiscard]] bool leaves_by(std::size_t i, std::int64_t x, std::int64_t u) const {
    const IndexRange raw = abstraction_.raw(i, x, u);
    return (raw.first < 0 && is_safe(grid_[i], false)) ||
           (raw.last >= grid_[i].count && is_safe(grid_[i], true));
  }

  [[nodiscard]] bool leaves(std::int64_t x, std::int64_t u) const {
    return std::any_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return leaves_by(side.dimension, x, u); });
  }

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
  const Abstraction& abstraction_;
  const UniformGrid& grid_;
  const CellSet& invariant_;
  CellPosts posts_;
  std::vector<Word> near_;
  std::vector<Side> sides_;
  std::int64_t last_ = 0;
};

/// Removes the cells from which some joint input leaves, in the rows owned.
void take_out_leaving(const Answers& answers, ThreadTeam& team, CellSet& cells) {
  const AnalysisContext& context = answers.context;
  std::vector<std::unique_ptr<LeavingInput>> inputs;
  for (int w = 0; w < team.size(); ++w) inputs.push_back(std::make_unique<LeavingInput>(answers));
  const RowEngine& engine = *context.engine;
  for_each_own_row(team, engine.share(), engine.rows(), 16, [&](ThreadTeam::Range range, int worker) {
    LeavingInput& input = *inputs[at(worker)];
    std::vector<std::int64_t> found;
    std::vector<Word> near(engine.row_words());
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      const MutableRow row = cells.row(r);
      if (!any_set(row)) continue;
      found.clear();
      std::ranges::copy(row, near.begin());
      input.keep_near(r, near);
      for_each_bit(ConstRow(near), [&](std::int64_t lane) {
        const std::int64_t x = r * engine.row_length() + lane;
        if ((context.over && context.over->test(x)) || !input.is_at(x)) return;
        found.push_back(lane);
      });
      for (const std::int64_t lane : found)
        row[at(lane / CellSet::kWordBits)] &= ~(Word{1} << (lane % CellSet::kWordBits));
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
