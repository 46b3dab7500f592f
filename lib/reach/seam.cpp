#include "reach/seam.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "expression/functions.hpp"
#include "expression/tape_builder.hpp"
#include "reach/shift.hpp"

namespace coordreq {
namespace {

using Index = TapeBuilder::Index;

/// In radians: far more than rounded constants cause, and still of no account.
const Rational& largest_mismatch() {
  static const Rational value = Rational(1) / 1000000000;
  return value;
}

/// pi is between this and this plus 1e-30.
const Rational& pi_from_below() {
  static const Rational value = Rational(mpz_class("3141592653589793238462643383279")) /
                                Rational(mpz_class("1" + std::string(30, '0')));
  return value;
}

const Rational& pi_from_above() {
  static const Rational value = pi_from_below() + 1 / Rational(mpz_class("1" + std::string(30, '0')));
  return value;
}

class Winder {
 public:
  Winder(const Program& equation, std::uint32_t slot, const Ring& ring, const SeamSlots& slots,
         Representative representative)
      : equation_(equation),
        slot_(slot),
        ring_(ring),
        slots_(slots),
        representative_(representative),
        period_(ring.upper - ring.lower),
        slopes_(find_slopes(equation, slot)) {}

  WoundEquation run() {
    for (Copy& copy : copies_) copy = Copy(equation_.nodes.size());
    find_needed();
    for (Index i = 0; i < equation_.nodes.size(); ++i) {
      for (const Use use : {kAsNumber, kInTurns}) {
        if (copies_[use][i].needed) copies_[use][i].index = write(i, use);
      }
    }
    result_.program = tape_.extract(copies_[kAsNumber].back().index);
    result_.program.text = equation_.text;
    return result_;
  }

 private:
  /// The use of a node. One that is used in both ways is written once for each.
  enum Use : std::uint8_t { kAsNumber, kInTurns };
  struct Copied {
    bool needed = false;
    Index index = 0;
  };
  using Copy = std::vector<Copied>;

  void find_needed() {
    copies_[kAsNumber].back().needed = true;
    for (std::size_t i = equation_.nodes.size(); i-- > 0;) {
      const Program::Node& node = equation_.nodes[i];
      const std::array<Index, 3> operands{node.a, node.b, node.c};
      for (const Use use : {kAsNumber, kInTurns}) {
        if (!copies_[use][i].needed) continue;
        const Use below = use_of_operands(node, use);
        for (std::size_t k = 0; k < operand_count(node.op); ++k) copies_[below][operands[k]].needed = true;
      }
    }
  }

  Use use_of_operands(const Program::Node& node, Use use) {
    if (use == kInTurns) return kInTurns;
    const std::optional<Rational> mismatch = mismatch_of(node);
    if (!mismatch) return kAsNumber;
    result_.mismatch = std::max(result_.mismatch, *mismatch);
    return kInTurns;
  }

  /// The difference of a period from whole turns of the node; nothing unless the node is periodic, as sin is,
  /// and the difference is small.
  [[nodiscard]] std::optional<Rational> mismatch_of(const Program::Node& node) const {
    const int half_turns =
        is_number_function(node.op) ? number_function(node.op).half_turns : NumberFunction::kNever;
    if (half_turns == NumberFunction::kNever) return std::nullopt;
    const Slope& slope = slopes_[node.a];
    if (!slope || *slope == 0) return std::nullopt;
    const Rational angle = abs(*slope) * period_;
    const Rational turns(floor_to_int(angle / (half_turns * pi_from_below()) + Rational(1, 2)));
    if (turns == 0) return std::nullopt;
    const Rational from_below = abs(angle - turns * half_turns * pi_from_below());
    const Rational from_above = abs(angle - turns * half_turns * pi_from_above());
    const Rational mismatch = std::max(from_below, from_above);
    if (mismatch > largest_mismatch()) return std::nullopt;
    return Rational(mismatch / abs(*slope));
  }

  Index write(Index i, Use use) {
    const Program::Node& node = equation_.nodes[i];
    if (node.op == Operator::constant) return tape_.constant(equation_.constants[node.a]);
    if (node.op == Operator::variable) return write_variable(node.a, use);
    const Copy& operands = copies_[use_of_operands(node, use)];
    const std::size_t count = operand_count(node.op);
    return tape_.apply(node.op, count > 0 ? operands[node.a].index : 0,
                       count > 1 ? operands[node.b].index : 0, count > 2 ? operands[node.c].index : 0);
  }

  Index write_variable(std::uint32_t slot, Use use) {
    const Index variable = tape_.variable(slot);
    if (slot != slot_) return variable;
    if (use == kInTurns) return tape_.apply(Operator::add, variable, tape_.variable(slots_.error));
    result_.as_number = true;
    if (representative_ == Representative::anywhere) return tape_.variable(slots_.anywhere);
    return followed(variable);
  }

  /// The value of a state that is followed round. Exactly on a seam, from below, it is `upper`, so that a box
  /// which just touches the seam is not cut. Boxes that are cut lead to values within the ring, too.
  Index followed(Index x) {
    Index value = x;
    for (int k = 1; k <= kMostTurns; ++k) {
      const Index beyond = tape_.apply(Operator::greater, x, tape_.constant(ring_.upper + (k - 1) * period_));
      const Index before = tape_.apply(Operator::less, x, tape_.constant(ring_.lower - (k - 1) * period_));
      value = tape_.apply(Operator::if_else, beyond, turned(x, k), value);
      value = tape_.apply(Operator::if_else, before, turned(x, -k), value);
    }
    value = tape_.apply(Operator::maximum, value, tape_.constant(ring_.lower));
    return tape_.apply(Operator::minimum, value, tape_.constant(ring_.upper));
  }

  Index turned(Index x, int times) {
    return tape_.apply(Operator::subtract, x, tape_.constant(times * period_));
  }

  const Program& equation_;
  std::uint32_t slot_;
  const Ring& ring_;
  const SeamSlots& slots_;
  Representative representative_;
  Rational period_;
  std::vector<Slope> slopes_;
  std::array<Copy, 2> copies_;  ///< [Use][node]
  TapeBuilder tape_;
  WoundEquation result_;
};

}  // namespace

WoundEquation wind(const Program& equation, std::uint32_t slot, const Ring& ring, const SeamSlots& slots,
                   Representative representative) {
  return Winder(equation, slot, ring, slots, representative).run();
}

}  // namespace coordreq
