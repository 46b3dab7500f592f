#include <map>
#include <memory>
#include <set>

#include "answers/checking/cell_pieces.hpp"
#include "answers/checking/corner_truth.hpp"
#include "base/error.hpp"
#include "expression/condition.hpp"
#include "expression/tape_builder.hpp"
#include "spec/system_spec.hpp"
#include "verify/parameter_choices.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {
namespace {

using SlotBox = std::vector<RationalInterval>;

/// One comparison of a condition, evaluated on all pieces of a cell. How hard the analysis tries decides what
/// is decided; what is decided is checked: a point that says otherwise makes it undecided here.
class CheckedComparison {
 public:
  explicit CheckedComparison(Program program)
      : program_(std::move(program)),
        slots_(program_.variables()),
        decider_(program_),
        everywhere_(program_, {slots_.begin(), slots_.end()}),
        negation_(negated(program_)),
        nowhere_(negation_, {slots_.begin(), slots_.end()}) {}

  /// @param pieces by slot
  [[nodiscard]] Truth at(const std::vector<SlotBox>& pieces) {
    std::vector<std::int64_t> counts;
    for (const std::uint32_t slot : slots_) counts.push_back(static_cast<std::int64_t>(pieces[slot].size()));
    SlotBox box(pieces.size());
    Odometer piece(counts);
    std::optional<Truth> result;
    do {
      for (std::size_t v = 0; v < slots_.size(); ++v)
        box[slots_[v]] = pieces[slots_[v]][static_cast<std::size_t>(piece[v])];
      const Truth truth = checked(box);
      result = !result || *result == truth ? truth : Truth::undecided;
    } while (piece.advance());
    return *result;
  }

 private:
  static Program negated(Program program) {
    program.nodes.push_back({Operator::logical_not, static_cast<std::uint32_t>(program.nodes.size() - 1)});
    return program;
  }

  Truth checked(const SlotBox& box) {
    std::vector<Interval> rough;
    for (const RationalInterval& range : box) rough.push_back(enclose(range));
    const Truth truth = decider_.decide(std::span<const Interval>(rough),
                                        [&] { return std::span<const RationalInterval>(box); });
    if (truth == Truth::undecided) return truth;
    const Truth everywhere = (truth == Truth::yes ? everywhere_ : nowhere_).everywhere(box);
    return everywhere == Truth::no ? Truth::undecided : truth;
  }

  Program program_;
  std::vector<std::uint32_t> slots_;
  ConditionDecider decider_;
  CornerTruth everywhere_;
  Program negation_;
  CornerTruth nowhere_;
};

/// Values of an update from its definition: down from the result, branch by branch.
class UpdateJudge {
 public:
  explicit UpdateJudge(const Program& program) : program_(program), comparisons_(program.nodes.size()) {
    TapeBuilder tape;
    std::vector<TapeBuilder::Index> here;
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
      here.push_back(tape.copy(program, program.nodes[i], here));
      if (is_comparison(program.nodes[i].op))
        comparisons_[i] = std::make_unique<CheckedComparison>(tape.extract(here.back()));
    }
  }

  /// @param pieces by slot
  [[nodiscard]] std::set<Rational> values(const std::vector<SlotBox>& pieces) {
    return values_of(program_.nodes.size() - 1, pieces);
  }
  [[nodiscard]] Truth truth(const std::vector<SlotBox>& pieces) {
    return truth_of(program_.nodes.size() - 1, pieces);
  }

 private:
  Truth truth_of(std::size_t i, const std::vector<SlotBox>& pieces) {
    const Program::Node& node = program_.nodes[i];
    switch (node.op) {
      case Operator::logical_and:
        return truth_and(truth_of(node.a, pieces), truth_of(node.b, pieces));
      case Operator::logical_or:
        return truth_or(truth_of(node.a, pieces), truth_of(node.b, pieces));
      case Operator::logical_not:
        return !truth_of(node.a, pieces);
      case Operator::literal_true:
        return Truth::yes;
      case Operator::literal_false:
        return Truth::no;
      case Operator::literal_undecided:
        return Truth::undecided;
      default:
        return comparisons_[i]->at(pieces);
    }
  }

  std::set<Rational> values_of(std::size_t i, const std::vector<SlotBox>& pieces) {
    const Program::Node& node = program_.nodes[i];
    if (node.op == Operator::constant) return {program_.constants[node.a]};
    if (node.op == Operator::variable) return {pieces[node.a].front().lower};
    if (node.op == Operator::if_else) {
      const Truth truth = truth_of(node.a, pieces);
      std::set<Rational> all;
      if (truth != Truth::no) all.merge(values_of(node.b, pieces));
      if (truth != Truth::yes) all.merge(values_of(node.c, pieces));
      return all;
    }
    const bool is_unary = operand_count(node.op) == 1;
    std::set<Rational> results;
    const std::set<Rational> left = values_of(node.a, pieces);
    const std::set<Rational> right = is_unary ? left : values_of(node.b, pieces);
    for (const Rational& a : left) {
      for (const Rational& b : right) {
        const std::optional<Rational> value = number_function(node.op).exactly(a, b);
        if (!value) throw SpecError("an update has a value that is not known exactly");
        results.insert(*value);
        if (is_unary) break;
      }
    }
    return results;
  }

  const Program& program_;
  std::vector<std::unique_ptr<CheckedComparison>> comparisons_;
};

/// The next value of a memory, from the meaning of its operator (contract, section 6).
Rational kept_value(const PastOperator& past, Truth one, Truth other, const std::vector<SlotBox>& pieces) {
  using Kind = PastOperator::Kind;
  const auto rank = [&](Truth truth) {
    if (truth == Truth::no) return 0L;
    return truth == Truth::yes && past.three_valued ? 2L : 1L;
  };
  const bool is_seen = past.possibly ? one != Truth::no : one == Truth::yes;
  const Rational now = rank(one);
  if (past.kind == Kind::previous) return now;
  const Rational before = pieces[past.slot].front().lower;
  const Rational most = static_cast<long>(past.samples - 1);
  switch (past.kind) {
    case Kind::once:
      return before > now ? before : now;
    case Kind::since: {
      const Rational held = now < before ? now : before;
      return held > rank(other) ? held : Rational(rank(other));
    }
    case Kind::within:
      if (is_seen) return most;
      return before > 0 ? Rational(before - 1) : Rational(0);
    default:
      if (!is_seen) return 0;
      return before < most ? Rational(before + 1) : most;
  }
}

std::vector<SlotBox> boxes_of(const GridDimension& dimension, bool centres) {
  std::vector<SlotBox> boxes;
  for (std::int64_t k = 0; k < dimension.count; ++k) {
    const Rational centre = dimension.point(k);
    boxes.push_back(centres ? SlotBox{{.lower = centre, .upper = centre}} : pieces_of(dimension, k));
  }
  return boxes;
}

IndexRange indices_of(const std::set<Rational>& values, const GridDimension& target) {
  std::set<std::int64_t> indices;
  for (const Rational& value : values) {
    const Rational index = (value - target.first) / target.step;
    if (!is_integer(index)) throw SpecError("the discrete state '" + target.name + "' can leave its grid");
    indices.insert(floor_to_int(index));
  }
  return cut_to_range(target, *indices.begin(), *indices.rbegin());
}

}  // namespace

PostTable update_posts(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                       std::size_t state, const std::vector<std::int64_t>& cells, ThreadTeam& team) {
  const Influences influences = influences_on(spec, state);
  PostTable table = empty_table(grid, inputs, influences, cells);
  const CellsOfTable all(grid, influences, table);
  const ParameterChoices choices(spec, grid, inputs, influences, table);
  std::vector<std::vector<SlotBox>> boxes;
  const UpdateSpec& update = *spec.dynamics.update(state);
  const bool centres = update.past && spec.abstraction.safe == Membership::center;
  for (const std::size_t j : influences.moving) boxes.push_back(boxes_of(grid[j], centres));
  team.for_each(choices.size(), 1, [&](ThreadTeam::Range range, int) {
    UpdateJudge judge(update.past ? update.past->first : update.value);
    UpdateJudge other(update.past ? update.past->second : update.value);
    const auto next = [&](const std::vector<SlotBox>& pieces) -> std::set<Rational> {
      if (!update.past) return judge.values(pieces);
      return {kept_value(*update.past, judge.truth(pieces), other.truth(pieces), pieces)};
    };
    Odometer choice(choices.counts(), range.begin);
    for (std::int64_t i = range.begin; i < range.end; ++i, choice.advance()) {
      std::vector<SlotBox> pieces;
      for (const Rational& value : choices.slots(choice))
        pieces.push_back({{.lower = value, .upper = value}});
      for (const std::size_t l : influences.disturbances) {
        const DisturbanceSpec& w = spec.disturbances[l];
        pieces[spec.disturbance_slot(l)] = {{.lower = w.lower, .upper = w.upper}};
      }
      all.for_each(choices.position(choice), std::nullopt,
                   [&](const std::vector<std::int64_t>& cell, std::int64_t position) {
                     for (std::size_t j = 0; j < cell.size(); ++j)
                       pieces[influences.moving[j]] = boxes[j][static_cast<std::size_t>(cell[j])];
                     table.entries[*table.find(position)] = indices_of(next(pieces), grid[state]);
                   });
    }
  });
  return table;
}

}  // namespace coordreq
