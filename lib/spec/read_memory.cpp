#include "spec/read_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "expression/cell_truth.hpp"
#include "expression/tape_builder.hpp"
#include "spec/grid_dimension.hpp"
#include "spec/problem_spec.hpp"
#include "spec/spec_errors.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Kind = PastOperator::Kind;
using Index = TapeBuilder::Index;

/// No slot of a spec is as large.
constexpr std::uint32_t kProvisional = 1U << 24U;

Kind kind_of(std::string_view operation) {
  if (operation == "previous") return Kind::previous;
  if (operation == "since") return Kind::since;
  if (operation == "within") return Kind::within;
  return operation == "for_last" ? Kind::for_last : Kind::once;
}

/// Operations on points that are decided whatever the points are.
bool is_decided_at_points(const Program& condition) {
  return std::all_of(condition.nodes.begin(), condition.nodes.end(), [](const Program::Node& node) {
    switch (node.op) {
      case Operator::divide:
      case Operator::power:
      case Operator::angle:
      case Operator::literal_undecided:
        return false;
      default:
        return !is_unary_function(node.op) || node.op == Operator::negate || node.op == Operator::absolute ||
               node.op == Operator::sign || node.op == Operator::floor;
    }
  });
}

Program negated(const Program& condition) {
  TapeBuilder tape;
  return tape.extract(tape.apply(Operator::logical_not, tape.merge(condition)));
}

/// The condition that the value kept in `slot` is at least `value`.
Index at_least(TapeBuilder& tape, std::uint32_t slot, std::int64_t value) {
  return tape.apply(Operator::greater_equal, tape.variable(slot),
                    tape.constant(Rational(static_cast<long>(value))));
}

/// The truth that follows from the past alone: true or undecided by the values that are kept.
Index remembered(TapeBuilder& tape, const PastOperator& past) {
  const std::int64_t full = past.kind == Kind::for_last ? past.samples - 1 : 1;
  if (!past.three_valued) return at_least(tape, past.slot, full);
  const std::uint32_t second = past.is_counted() ? past.slot + 1 : past.slot;
  const Index certain = at_least(tape, past.slot, past.is_counted() ? full : 2);
  const Index possible = at_least(tape, second, full);
  return tape.apply(Operator::logical_or, certain,
                    tape.apply(Operator::logical_and, possible, tape.apply(Operator::literal_undecided)));
}

/// The truth of an operator at the present sample.
Program truth_of(const PastOperator& past, bool always) {
  TapeBuilder tape;
  const Index one = tape.merge(past.first);
  const auto both = [&](Index a, Index b) { return tape.apply(Operator::logical_and, a, b); };
  const auto either = [&](Index a, Index b) { return tape.apply(Operator::logical_or, a, b); };
  if (past.is_counted() && past.samples == 1) return past.first;
  const Index before = remembered(tape, past);
  switch (past.kind) {
    case Kind::previous:
      return tape.extract(before);
    case Kind::since:
      return tape.extract(either(tape.merge(past.second), both(one, before)));
    case Kind::for_last:
      return tape.extract(both(one, before));
    default:
      break;
  }
  const Index seen = either(one, before);
  return tape.extract(always ? tape.apply(Operator::logical_not, seen) : seen);
}

ConditionAxis axis_of(const StateSpec& state, Membership membership) {
  return {state.grid.count, [dimension = dimension_of(state), membership](std::int64_t k) {
            ConditionAxis::Ranges ranges;
            if (membership == Membership::center)
              ranges.push_back({.lower = dimension.point(k), .upper = dimension.point(k)});
            if (membership == Membership::center) return ranges;
            for (const Piece& piece : pieces(dimension, k))
              ranges.push_back({.lower = piece.lower, .upper = piece.upper});
            return ranges;
          }};
}

ConditionAxis axis_of_values(std::int64_t count) {
  return {count, [](std::int64_t k) {
            const Rational value(static_cast<long>(k));
            return ConditionAxis::Ranges{{.lower = value, .upper = value}};
          }};
}

}  // namespace

MemoryReader::MemoryReader(const JsonDocument::Node& root) {
  if (!root.has("memory")) return;
  const JsonDocument::Node object = root["memory"];
  ErrorList errors;
  for (const std::string& name : object.keys_as_written()) {
    const JsonDocument::Node node = object[name];
    names_.push_back(name);
    errors.attempt([&] {
      Formula& formula = formulas_[name];
      formula.text = node.text();
      formula.pointer = node.pointer();
      formula.structure = take_apart_formula(formula.text, formula.pointer);
      for (const MemoryFormula::Call& call : formula.structure.calls) {
        Call& past_call = formula.calls.emplace_back();
        past_call.past.kind = kind_of(call.operation);
        past_call.always = call.operation == "always";
      }
    });
  }
  errors.raise();
}

std::vector<std::string> MemoryReader::mentioned(const std::string& name, const TableLookup& tables) const {
  const Formula& formula = formulas_.at(name);
  std::vector<std::string> names;
  const auto add = [&](const FormulaSegment& segment) {
    for (std::string& mention : mentioned_names(segment.text, tables, formula.pointer)) {
      if (segment.call(mention) == nullptr) names.push_back(std::move(mention));
    }
  };
  add(formula.structure.whole);
  for (const MemoryFormula::Call& call : formula.structure.calls)
    std::for_each(call.arguments.begin(), call.arguments.end(), add);
  return names;
}

void MemoryReader::look_at(const std::vector<StateSpec>& states, Membership membership) {
  states_ = states;
  membership_ = membership;
  phase_ = Phase::provisional;
  next_slot_ = kProvisional;
}

bool MemoryReader::are_linked(Phase phase) const {
  return std::ranges::all_of(names_, [&](const std::string& name) {
    return phase_ == phase && !formulas_.at(name).truth.nodes.empty();
  });
}

void MemoryReader::settle() {
  REQUIRES(are_linked(Phase::provisional));
  phase_ = Phase::final;
  std::size_t slot = states_.size();
  for (const std::string& name : names_) {
    for (Call& call : formulas_.at(name).calls) {
      call.past.slot = static_cast<std::uint32_t>(slot);
      slot += call.kept();
    }
  }
}

Program MemoryReader::linked(const std::string& name, const Lookup& find, const TableLookup& tables) {
  if (phase_ == Phase::names) {
    TapeBuilder tape;
    return tape.extract(tape.apply(Operator::literal_true));
  }
  Formula& formula = formulas_.at(name);
  for (std::size_t i = formula.calls.size(); i-- > 0;)
    link_call(formula, i, find, tables);  // inner ones first
  formula.truth = link_segment(formula, formula.structure.whole, ExpectedType::condition, find, tables);
  formula.truth.text = formula.text;
  return formula.truth;
}

Program MemoryReader::link_segment(Formula& formula, const FormulaSegment& segment, ExpectedType expected,
                                   const Lookup& find, const TableLookup& tables) {
  const Lookup lookup = [&](std::string_view name) -> Binding {
    const std::size_t* const call = segment.call(name);
    if (call == nullptr) return find(name);
    const Call& past_call = formula.calls[*call];
    return std::make_shared<const Program>(truth_of(past_call.past, past_call.always));
  };
  return link(segment.text, lookup, tables, expected, formula.pointer);
}

void MemoryReader::link_call(Formula& formula, std::size_t number, const Lookup& find,
                             const TableLookup& tables) {
  Call& call = formula.calls[number];
  const std::vector<FormulaSegment>& arguments = formula.structure.calls[number].arguments;
  if (call.past.is_counted()) call.past.samples = read_samples(formula, arguments.front(), find, tables);
  const FormulaSegment& first = call.past.is_counted() ? arguments.back() : arguments.front();
  call.past.first = link_segment(formula, first, ExpectedType::condition, find, tables);
  if (call.always) call.past.first = negated(call.past.first);
  call.past.second = call.past.first;
  if (call.past.kind == Kind::since)
    call.past.second = link_segment(formula, arguments.back(), ExpectedType::condition, find, tables);
  if (phase_ != Phase::provisional) return;
  call.past.three_valued = can_be_undecided(call.past.first) ||
                           (call.past.kind == Kind::since && can_be_undecided(call.past.second));
  call.past.slot = next_slot_;
  for (std::size_t k = 0; k < call.kept(); ++k) values_[next_slot_++] = call.past.values();
}

std::int64_t MemoryReader::read_samples(Formula& formula, const FormulaSegment& segment, const Lookup& find,
                                        const TableLookup& tables) {
  constexpr long kMost = (1L << 31U) - 2;
  const Program program = link_segment(formula, segment, ExpectedType::number, find, tables);
  const bool is_constant = program.variables().empty();
  const Rational value = is_constant ? constant_value(program, formula.pointer) : Rational(0);
  if (is_constant && is_integer(value) && value >= 1 && value <= kMost) return floor_to_int(value);
  std::string text = segment.text;
  text.erase(0, text.find_first_not_of(" \n"));
  text.erase(text.find_last_not_of(" \n") + 1);
  throw SpecError(fmt::format("expected a constant integer from 1 to {} as the number of samples, found {}",
                              kMost, quote_text(text)),
                  formula.pointer);
}

/// On any cell, with any values of what is kept.
bool MemoryReader::can_be_undecided(const Program& condition) const {
  const std::vector<std::uint32_t> slots = condition.variables();
  const auto is_point = [&](std::uint32_t slot) {
    return slot >= states_.size() || membership_ == Membership::center || states_[slot].discrete;
  };
  if (std::all_of(slots.begin(), slots.end(), is_point) && is_decided_at_points(condition)) return false;
  Program numbered = condition;  // by place among its variables
  std::vector<ConditionAxis> axes;
  for (const std::uint32_t slot : slots)
    axes.push_back(slot < states_.size() ? axis_of(states_[slot], membership_)
                                         : axis_of_values(values_.at(slot)));
  for (Program::Node& node : numbered.nodes) {
    if (node.op != Operator::variable) continue;
    node.a = static_cast<std::uint32_t>(std::lower_bound(slots.begin(), slots.end(), node.a) - slots.begin());
  }
  CellTruth truth(numbered, axes);
  std::vector<std::int64_t> indices(axes.size(), 0);
  while (true) {
    if (truth.at(indices) == Truth::undecided) return true;
    std::size_t i = axes.size();
    while (i > 0 && ++indices[i - 1] == axes[i - 1].count) indices[--i] = 0;
    if (i == 0) return false;
  }
}

std::vector<std::string> MemoryReader::kept_by(const std::string& name) const {
  std::vector<std::string> names;
  if (phase_ != Phase::final) return names;
  std::size_t count = 0;
  for (const Call& call : formulas_.at(name).calls) count += call.kept();
  for (std::size_t k = 1; k <= count; ++k)
    names.push_back(name + "_past" + (count == 1 ? "" : std::to_string(k)));
  return names;
}

void MemoryReader::add_to(ProblemSpec& spec) const {
  REQUIRES(are_linked(Phase::final));
  Program zero;
  zero.nodes = {{Operator::constant}};
  zero.constants = {0};
  for (const std::string& name : names_) {
    const Formula& formula = formulas_.at(name);
    zero.text = name + " = " + formula.text;
    const std::vector<std::string> kept = kept_by(name);
    std::size_t number = 0;
    for (const Call& call : formula.calls) {
      for (std::size_t k = 0; k < call.kept(); ++k, ++number) {
        PastOperator past = call.past;
        past.slot += static_cast<std::uint32_t>(k);
        past.possibly = k == 1;
        spec.states.push_back({.name = kept[number],
                               .grid = {.first = 0, .step = 1, .count = past.values()},
                               .lower = 0,
                               .upper = Rational(static_cast<long>(past.values() - 1)),
                               .discrete = true,
                               .below = Outside::saturate,
                               .above = Outside::saturate});
        spec.dynamics.equations.push_back(zero);
        spec.dynamics.updates.emplace_back(UpdateSpec{.value = zero, .past = std::move(past)});
      }
    }
    spec.memory.push_back({.name = name, .truth = formula.truth, .states = kept});
  }
}

}  // namespace coordreq
