#include "analysis/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>

#include "answers/one_cell/cell_members.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "expression/evaluate.hpp"
#include "reach/point_flow.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Reads of tables and of sets, of all pairs together: a share of the cells, so that the search stays small
/// beside the analysis; on small grids a few for each cell.
constexpr std::int64_t kFewestReads = 20'000, kManyReads = 100'000, kMostReads = 2'000'000;
constexpr std::int64_t kCellsOfRead = 16, kReadsOfCell = 3;
/// Solutions that are followed, and the sub-steps of each.
constexpr std::int64_t kMostFollowed = 500;
constexpr std::int64_t kMostSubSteps = 64;
/// Joint inputs tried at a cell.
constexpr std::int64_t kInputsOfCell = 8;
/// Cells of a post that are looked at; larger ones are skipped.
constexpr std::int64_t kMostOfPost = 4096;
constexpr double kGoldenRatio = 0.6180339887498949;
constexpr double kPathTolerance = 1e-6;

/// A passage that was found: its beginning, and the state outside S.
struct Passage {
  std::vector<double> begin;  ///< [state]
  std::vector<double> there;
  bool is_unsafe = false;  ///< there the condition itself fails, not that of all of the cell
  std::vector<double> end;
  std::int64_t input = 0;
};

/// By index of each dimension of the grid of the abstraction, the nearest to a real one: in the domain, or
/// -1.
std::int64_t index_near(const GridDimension& dimension, double real) {
  auto index = static_cast<std::int64_t>(std::floor(real + 0.5));
  if (dimension.periodic()) index = (index % dimension.count + dimension.count) % dimension.count;
  if (index < 0) return traits(dimension.below).clamps ? 0 : -1;
  if (index >= dimension.count) return traits(dimension.above).clamps ? dimension.count - 1 : -1;
  return index;
}

/// What was found at a cell: the first passage where the condition fails, else the first.
struct Looked {
  std::optional<Passage> found;
  SearchWork work;
};

/// Looks for passages from one cell after another. One object a thread.
class CellSearch {
 public:
  CellSearch(const AnalysisContext& context, const CellSet& kept)
      : context_(context),
        abstraction_(*context.abstraction),
        grid_(abstraction_.grid),
        kept_(kept),
        posts_(abstraction_),
        is_safe_(context.spec.safe),
        at_(grid_.size()),
        chosen_(abstraction_.inputs.size()),
        moved_(grid_.size()) {}

  /// @param u before the first of the joint inputs to be tried, each `far_input` after the one before
  Looked look(std::int64_t x, std::int64_t u, std::int64_t far_input) {
    const std::int64_t choices = abstraction_.inputs.count();
    Looked looked;
    work_ = {};
    for (std::size_t i = 0; i < grid_.size(); ++i) at_[i] = grid_.index(x, i);
    for (std::int64_t j = 0; j < inputs_of_cell(choices); ++j) {
      u = (u + far_input) % choices;
      if (!may_pass(u) || !is_admissible(x, u)) continue;
      std::optional<Passage> found = follow(x, u);
      const bool is_unsafe = found && found->is_unsafe;
      if (is_unsafe || !looked.found) looked.found = std::move(found);
      if (is_unsafe) break;
    }
    looked.work = work_;
    return looked;
  }

  [[nodiscard]] static std::int64_t inputs_of_cell(std::int64_t choices) {
    return std::min(kInputsOfCell, choices);
  }

 private:
  /// Whether a straight line from the cell `at_` to the middle of its post passes a cell outside S.
  bool may_pass(std::int64_t u) {
    double most = 0;
    work_.reads += static_cast<std::int64_t>(grid_.size());
    for (std::size_t j = 0; j < chosen_.size(); ++j) chosen_[j] = abstraction_.inputs.index(u, j);
    const auto state = [this](std::size_t i) { return at_[i]; };
    const auto input = [this](std::size_t j) { return chosen_[j]; };
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const IndexRange raw = abstraction_.tables[i].range(i, state, input);
      if (raw.first == std::numeric_limits<std::int32_t>::min() ||
          raw.last == std::numeric_limits<std::int32_t>::max())
        return false;
      const double middle = (static_cast<double>(raw.first) + raw.last) / 2;
      moved_[i] =
          context_.spec.dynamics.update(grid_.state(i)) != nullptr ? 0 : middle - static_cast<double>(at_[i]);
      most = std::max(most, std::fabs(moved_[i]));
    }
    substeps_ = std::min(kMostSubSteps, static_cast<std::int64_t>(std::ceil(most)));
    for (std::int64_t substep = 1; substep < substeps_; ++substep) {
      ++work_.reads;
      const double share = static_cast<double>(substep) / static_cast<double>(substeps_);
      if (is_outside([&](std::size_t i) { return static_cast<double>(at_[i]) + share * moved_[i]; }))
        return true;
    }
    return false;
  }

  /// Whether a point is in a cell of the domain, but not in S. @param real its real index in each dimension
  template <class Real>
  [[nodiscard]] bool is_outside(const Real& real) const {
    std::int64_t cell = 0;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const std::int64_t index = index_near(grid_[i], real(i));
      if (index < 0) return false;
      cell += index * grid_.stride(i);
    }
    return !context_.safe.test(cell);
  }

  /// The pair is allowed, and its post is there and in what is kept.
  bool is_admissible(std::int64_t x, std::int64_t u) {
    const PairTable* const allow = context_.pairs.admissible();
    const std::int64_t row = x / grid_.row_length(), column = x % grid_.row_length();
    if (allow != nullptr &&
        (allow->row(row, u)[at(column / CellSet::kWordBits)] >> (column % CellSet::kWordBits) & 1) == 0)
      return false;
    posts_.move_to(x);
    const CellPost post = posts_.post(u, {});
    if (post.blocked != CellPost::Blocked::no) return false;
    return post.all_left || lies_inside(post);
  }

  bool lies_inside(const CellPost& post) {
    std::int64_t cells = 1;
    for (const IndexRange range : post.box) {
      cells *= std::int64_t{range.last} - range.first + 1;
      if (cells > kMostOfPost) return false;
    }
    work_.reads += cells;
    return for_each_cell(grid_, post.box, [this](std::int64_t cell) { return kept_.test(cell); });
  }

  /// The solution from the centre of the cell.
  std::optional<Passage> follow(std::int64_t x, std::int64_t u) {
    ++work_.followed;
    const SystemSpec& spec = context_.spec;
    SystemSpec divided = spec;
    const std::int64_t substeps = std::min(kMostSubSteps, 2 * substeps_);
    divided.dynamics.period /= static_cast<long>(substeps);
    std::vector<std::int32_t> moving(spec.states.size());
    std::iota(moving.begin(), moving.end(), 0);
    PointFlow flow(divided, moving, kPathTolerance);
    std::vector<double> slots(spec.slot_count());
    for (std::size_t i = 0; i < grid_.size(); ++i)
      slots[spec.state_slot(grid_.state(i))] = nearest_double(grid_[i].point(grid_.index(x, i)));
    for (std::size_t j = 0; j < abstraction_.inputs.size(); ++j)
      slots[spec.input_slot(j)] =
          nearest_double(abstraction_.inputs[j].values[at(abstraction_.inputs.index(u, j))]);
    for (std::size_t l = 0; l < spec.disturbances.size(); ++l)
      slots[spec.disturbance_slot(l)] =
          nearest_double((spec.disturbances[l].lower + spec.disturbances[l].upper) / 2);
    const auto states = [&] {
      return std::vector<double>(slots.begin(),
                                 slots.begin() + static_cast<std::ptrdiff_t>(spec.states.size()));
    };
    Passage found{.begin = states(), .input = u};
    for (std::int64_t k = 1; k <= substeps; ++k) {
      const auto end = flow.after_period(slots);
      if (!end) return std::nullopt;
      std::copy(end->begin(), end->end(), slots.begin());
      if (k == substeps || found.is_unsafe || !is_outside([&](std::size_t i) {
            const double value = slots[spec.state_slot(grid_.state(i))];
            return (value - nearest_double(grid_[i].first)) / nearest_double(grid_[i].step);
          }))
        continue;
      found.is_unsafe = is_safe_.condition(slots) == Truth::no;
      if (found.is_unsafe || found.there.empty()) found.there = states();
    }
    if (found.there.empty()) return std::nullopt;
    found.end = states();
    return found;
  }

  const AnalysisContext& context_;
  const Abstraction& abstraction_;
  const UniformGrid& grid_;
  const CellSet& kept_;
  CellPosts posts_;
  Evaluator<double> is_safe_;
  std::vector<std::int64_t> at_;      ///< [dimension] index of the cell that is looked at
  std::vector<std::int64_t> chosen_;  ///< [input] index of its value
  std::vector<double> moved_;         ///< [dimension] to the middle of the post
  std::int64_t substeps_ = 0;         ///< of the straight line
  SearchWork work_;
};

/// Looks at cells far from one another, in *rounds* that all threads share. What it finds, and the work that
/// counts, is what one cell after the other would have found.
class PassageSearch {
 public:
  PassageSearch(const AnalysisContext& context, const CellSet& kept, ThreadTeam& team)
      : context_(context),
        grid_(context.abstraction->grid),
        kept_(kept),
        team_(team),
        far_(step_through(grid_.points())),
        choices_(context.abstraction->inputs.count()),
        far_input_(step_through(choices_)) {
    for (int w = 0; w < team.size(); ++w) workers_.emplace_back(context, kept);
  }

  std::optional<Passage> run() {
    const std::int64_t all = grid_.points();
    const std::int64_t fewest = std::clamp(all * kReadsOfCell, kFewestReads, kManyReads);
    const std::int64_t most_reads = std::clamp(all / kCellsOfRead, fewest, kMostReads);
    const auto goes_on = [&] { return work_.reads < most_reads && work_.followed < kMostFollowed; };
    std::optional<Passage> first;
    std::int64_t size = 1;
    for (std::int64_t begin = 0; begin < all && goes_on(); begin += std::ssize(round_)) {
      look_at(std::min(size, all - begin));
      bool is_any_followed = false;
      for (std::size_t k = 0; k < round_.size() && goes_on(); ++k) {
        Looked& looked = round_[k].looked;
        work_.reads += 1 + looked.work.reads;
        work_.followed += looked.work.followed;
        is_any_followed = is_any_followed || looked.work.followed > 0;
        if (looked.found && looked.found->is_unsafe) return looked.found;
        if (!first) first = std::move(looked.found);
      }
      size = is_any_followed ? kLeastRound : std::min(2 * size, kMostRound);
    }
    return first;
  }

  [[nodiscard]] const SearchWork& work() const { return work_; }

 private:
  /// Cells of a round: few while solutions are followed, which takes long and may be in vain for those after
  /// the last that counts.
  static constexpr std::int64_t kLeastRound = 8, kMostRound = 4096;
  /// Cells that one thread takes at a time.
  static constexpr std::int64_t kCellsAtOnce = 64;

  struct Probe {
    std::int64_t cell = 0;  ///< by its number in the order of the spec at first
    bool is_kept = false;
    std::int64_t input = 0;  ///< look()
    Looked looked;
  };

  /// Steps of this length, modulo `count`, come to all of them, those soon after one another far apart.
  static std::int64_t step_through(std::int64_t count) {
    auto step =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(kGoldenRatio * static_cast<double>(count)));
    while (std::gcd(step, count) != 1) ++step;
    return step;
  }

  /// The k-th of all cells.
  [[nodiscard]] std::int64_t cell_of(std::int64_t k) const {
    std::int64_t cell = 0;
    for (std::size_t i = grid_.size(); i-- > 0; k /= grid_[i].count)
      cell += k % grid_[i].count * grid_.stride(i);
    return cell;
  }

  /// round_ = the next cells, looked at.
  void look_at(std::int64_t size) {
    round_.clear();
    round_.resize(static_cast<std::size_t>(size));
    for (Probe& probe : round_) {
      probe.cell = number_;
      number_ = (number_ + far_) % grid_.points();
    }
    const auto each = [&](const auto& visit) {
      team_.for_each(size, is_small(size) ? 1 : kCellsAtOnce, [&](ThreadTeam::Range range, int worker) {
        for (std::int64_t k = range.begin; k < range.end; ++k) visit(round_[at(k)], worker);
      });
    };
    each([this](Probe& probe, int) {
      probe.cell = cell_of(probe.cell);
      probe.is_kept = kept_.test(probe.cell) && !(context_.terminal && context_.terminal->test(probe.cell));
    });
    for (Probe& probe : round_) {
      if (!probe.is_kept) continue;
      probe.input = input_;
      input_ = (input_ + CellSearch::inputs_of_cell(choices_) * far_input_) % choices_;
    }
    each([this](Probe& probe, int worker) {
      if (probe.is_kept) probe.looked = workers_[at(worker)].look(probe.cell, probe.input, far_input_);
    });
  }
  [[nodiscard]] static bool is_small(std::int64_t size) { return size <= kLeastRound; }

  const AnalysisContext& context_;
  const UniformGrid& grid_;
  const CellSet& kept_;
  ThreadTeam& team_;
  std::int64_t far_;  ///< from one cell to the next
  std::int64_t choices_;
  std::int64_t far_input_;
  std::int64_t number_ = 0;
  std::int64_t input_ = 0;
  std::deque<CellSearch> workers_;
  std::vector<Probe> round_;
  SearchWork work_;
};

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string values_of(const SystemSpec& spec, const std::vector<double>& values) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < values.size(); ++i)
    all.push_back(fmt::format("{} = {}", spec.states[i].name, with_unit(values[i], spec.states[i].unit)));
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string inputs_of(const Abstraction& abstraction, const SystemSpec& spec, std::int64_t u) {
  std::vector<std::string> all;
  for (std::size_t j = 0; j < abstraction.inputs.size(); ++j) {
    const Rational& value = abstraction.inputs[j].values[at(abstraction.inputs.index(u, j))];
    all.push_back(
        fmt::format("{} = {}", spec.inputs[j].name, with_unit(nearest_double(value), spec.inputs[j].unit)));
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

/// "p1 moves by 10 m", of the state that moves by the most cells.
std::string longest_motion(const SystemSpec& spec, const Passage& passage) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const double cells =
        std::fabs(passage.end[i] - passage.begin[i]) / nearest_double(spec.states[i].grid.step);
    if (cells <= most) continue;
    most = cells;
    longest = i;
  }
  const StateSpec& state = spec.states[longest];
  return fmt::format("{} moves by {} unseen", state.name,
                     with_unit(std::fabs(passage.end[longest] - passage.begin[longest]), state.unit));
}

}  // namespace

Warnings advise_on_unseen_motion(const AnalysisContext& context, const CellSet& kept, ThreadTeam& team,
                                 SearchWork& work) {
  REQUIRES(context.engine && context.hull && !context.share &&
           kept.rows() == context.abstraction->grid.rows());
  const ProblemSpec& spec = context.spec;
  if (spec.dynamics.time == Time::discrete || spec.abstraction.between_samples) return {};
  PassageSearch search(context, kept, team);
  const std::optional<Passage> found = search.run();
  work = search.work();
  if (!found) return {};
  return {
      {"between_samples", "/abstraction",
       fmt::format("safety is asked only at samples, every {}: from {}, with {}, the motion to the next one "
                   "{}, at {}, and {}; \"between_samples\": true asks for "
                   "safety at all times",
                   with_unit(nearest_double(spec.dynamics.period), spec.dynamics.unit),
                   values_of(spec, found->begin), inputs_of(*context.abstraction, spec, found->input),
                   found->is_unsafe ? "is not safe" : "passes cells outside the safe set",
                   values_of(spec, found->there), longest_motion(spec, *found))}};
}

}  // namespace coordreq
