#include "reach/shift.hpp"

#include <utility>

namespace coordreq {
namespace {

class SlopeFinder {
 public:
  SlopeFinder(const Program& program, std::uint32_t variable) : program_(program), variable_(variable) {}

  std::vector<Slope> find() {
    for (const Program::Node& node : program_.nodes) slopes_.push_back(slope_of(node));
    return std::move(slopes_);
  }

 private:
  [[nodiscard]] bool is_constant(std::uint32_t i) const { return program_.nodes[i].op == Operator::constant; }
  [[nodiscard]] const Rational& constant(std::uint32_t i) const {
    return program_.constants[program_.nodes[i].a];
  }

  [[nodiscard]] Slope slope_of(const Program::Node& node) const {
    if (node.op == Operator::constant || node.op == Operator::literal_true ||
        node.op == Operator::literal_false) {
      return Rational(0);
    }
    if (node.op == Operator::variable) return Rational(node.a == variable_ ? 1 : 0);
    const Slope& a = slopes_[node.a];
    if (!a) return std::nullopt;
    if (node.op == Operator::negate) return Rational(-*a);
    if (is_unary_function(node.op) || node.op == Operator::logical_not) return where(*a == 0, 0);
    const Slope& b = slopes_[node.b];
    if (!b) return std::nullopt;
    if (node.op == Operator::if_else) {
      const Slope& c = slopes_[node.c];
      return where(*a == 0 && c && *b == *c, *b);
    }
    if (is_comparison(node.op)) return where(*a == *b, 0);
    return slope_of_pair(node, *a, *b);
  }

  [[nodiscard]] Slope slope_of_pair(const Program::Node& node, const Rational& a, const Rational& b) const {
    switch (node.op) {
      case Operator::add:
        return Rational(a + b);
      case Operator::subtract:
        return Rational(a - b);
      case Operator::minimum:
      case Operator::maximum:
        return where(a == b, a);
      case Operator::multiply:
        if (is_constant(node.a)) return Rational(constant(node.a) * b);
        if (is_constant(node.b)) return Rational(a * constant(node.b));
        break;
      case Operator::divide:
        if (is_constant(node.b) && constant(node.b) != 0) return Rational(a / constant(node.b));
        break;
      default:
        break;
    }
    return where(a == 0 && b == 0, 0);
  }

  static Slope where(bool known, const Rational& slope) { return known ? Slope(slope) : std::nullopt; }

  const Program& program_;
  std::uint32_t variable_;
  std::vector<Slope> slopes_;
};

}  // namespace

std::vector<Slope> find_slopes(const Program& program, std::uint32_t variable) {
  return SlopeFinder(program, variable).find();
}

}  // namespace coordreq
