#include "reach/affine_part.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "expression/evaluate.hpp"
#include "reach/sensitivity.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

using Slots = std::vector<bool>;

/// Largest norm times duration that the series is used for.
constexpr double kLongest = 8.0;
constexpr int kMostHalvings = 8;

void unite(Slots& a, const Slots& b) {
  for (std::size_t s = 0; s < a.size(); ++s) {
    if (b[s]) a[s] = true;
  }
}

bool any(const Slots& a) {
  return std::find(a.begin(), a.end(), true) != a.end();
}

/// Walks over an equation and finds the candidates in which it is not affine with constant coefficients.
class AffineCheck {
 public:
  /// @param constant slots of inputs and parameters
  /// @param candidates slots of states that may be in A
  AffineCheck(const Slots& constant, const Slots& candidates)
      : constant_(constant),
        candidates_(candidates),
        offenders_(constant.size(), false),
        coefficients_(constant.size(), false),
        mentioned_(constant.size(), false) {}

  void check(const Program& program) {
    forms_.clear();
    for (const Program::Node& node : program.nodes) forms_.push_back(form_of(node));
    unite(mentioned_, forms_.back().linear);
  }

  [[nodiscard]] const Slots& offenders() const { return offenders_; }
  /// Constants that stand in some coefficient of a candidate.
  [[nodiscard]] const Slots& coefficients() const { return coefficients_; }
  /// Candidates that the equations depend on.
  [[nodiscard]] const Slots& mentioned() const { return mentioned_; }

 private:
  struct Form {
    Slots linear;         ///< candidates in which the node is affine
    Slots constants;      ///< constants that it depends on
    bool moving = false;  ///< it depends on something else, too
    [[nodiscard]] bool is_constant() const { return !moving && !any(linear); }
  };

  [[nodiscard]] Form empty() const {
    return {.linear = Slots(constant_.size(), false), .constants = Slots(constant_.size(), false)};
  }

  [[nodiscard]] Form variable(std::uint32_t slot) const {
    Form form = empty();
    form.linear[slot] = candidates_[slot];
    form.constants[slot] = constant_[slot];
    form.moving = !candidates_[slot] && !constant_[slot];
    return form;
  }

  static Form sum(const Form& a, const Form& b) {
    Form form = a;
    unite(form.linear, b.linear);
    unite(form.constants, b.constants);
    form.moving = a.moving || b.moving;
    return form;
  }

  Form scaled(const Form& factor, const Form& form) {
    if (any(form.linear)) unite(coefficients_, factor.constants);
    return sum(form, factor);
  }

  /// Anything else: only what is constant stays so.
  Form other(const Form& all) {
    if (all.is_constant()) return all;
    unite(offenders_, all.linear);
    Form form = empty();
    form.moving = true;
    return form;
  }

  Form form_of(const Program::Node& node) {
    if (node.op == Operator::variable) return variable(node.a);
    if (node.op == Operator::constant || node.op == Operator::literal_true ||
        node.op == Operator::literal_false) {
      return empty();
    }
    const Form& a = forms_[node.a];
    if (node.op == Operator::negate) return a;
    if (is_unary_function(node.op) || node.op == Operator::logical_not) return other(a);
    const Form& b = forms_[node.b];
    switch (node.op) {
      case Operator::add:
      case Operator::subtract:
        return sum(a, b);
      case Operator::multiply:
        if (a.is_constant()) return scaled(a, b);
        if (b.is_constant()) return scaled(b, a);
        break;
      case Operator::divide:
        if (b.is_constant()) return scaled(b, a);
        break;
      case Operator::if_else: {
        const Form branches = sum(b, forms_[node.c]);
        return a.is_constant() ? scaled(a, branches) : other(sum(a, branches));
      }
      default:
        break;
    }
    return other(sum(a, b));
  }

  const Slots& constant_;
  const Slots& candidates_;
  Slots offenders_;
  Slots coefficients_;
  Slots mentioned_;
  std::vector<Form> forms_;
};

bool may_be_affine(const StateSpec& state) {
  const auto allowed = [](Outside rule) { return rule != Outside::stop && rule != Outside::periodic; };
  return allowed(state.below) && allowed(state.above);
}

AffinePart part_of(const SystemSpec& spec, const Dependencies& dependencies, const Slots& states,
                   const Slots& coefficients) {
  AffinePart part;
  for (const std::int32_t j : dependencies.moving) {
    if (states[spec.state_slot(at(j))]) part.states.push_back(j);
  }
  for (const std::int32_t j : dependencies.inputs) {
    if (coefficients[spec.input_slot(at(j))]) part.inputs.push_back(j);
  }
  for (const std::int32_t j : dependencies.parameters) {
    if (coefficients[spec.state_slot(at(j))]) part.parameters.push_back(j);
  }
  return part;
}

}  // namespace

AffinePart find_affine_part(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state) {
  const bool flow = spec.dynamics.time == Time::continuous;
  Slots constant(spec.slot_count(), false);
  for (const std::int32_t j : dependencies.inputs) constant[spec.input_slot(at(j))] = true;
  for (const std::int32_t j : dependencies.parameters) constant[spec.state_slot(at(j))] = true;
  Slots candidates(spec.slot_count(), false);
  for (const std::int32_t j : dependencies.moving) {
    candidates[spec.state_slot(at(j))] = may_be_affine(spec.states[at(j)]);
  }
  for (;;) {
    AffineCheck inside(constant, candidates);   // equations of which the affine part is used
    AffineCheck outside(constant, candidates);  // equations that may not mention it
    if (!flow) inside.check(spec.dynamics.equations[state]);
    for (std::size_t k = 0; flow && k < dependencies.moving.size(); ++k) {
      const std::size_t j = at(dependencies.moving[k]);
      (candidates[spec.state_slot(j)] ? inside : outside).check(spec.dynamics.equations[j]);
    }
    Slots dropped = inside.offenders();
    unite(dropped, outside.offenders());
    unite(dropped, outside.mentioned());
    if (!any(dropped)) return part_of(spec, dependencies, candidates, inside.coefficients());
    for (std::size_t s = 0; s < dropped.size(); ++s) {
      if (dropped[s]) candidates[s] = false;
    }
  }
}

AffineCoefficients::AffineCoefficients(const SystemSpec& spec, const AffinePart& part, std::size_t state)
    : spec_(&spec), part_(part) {
  REQUIRES(!part.states.empty());
  if (spec.dynamics.time == Time::discrete) {
    equations_.push_back(state);
  } else {
    for (const std::int32_t j : part.states) equations_.push_back(at(j));
  }
  for (const StateSpec& any : spec.states) slots_.push_back(Dual::constant(range_of(any)));
  for (const InputSpec& any : spec.inputs) slots_.push_back(Dual::constant(range_of(any)));
  slots_.resize(spec.slot_count());
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec.disturbances[l];
    slots_[spec.disturbance_slot(l)] = Dual::constant({lower_double(w.lower), upper_double(w.upper)});
  }
  matrix_.resize(static_cast<Eigen::Index>(equations_.size()), static_cast<Eigen::Index>(part.states.size()));
}

bool AffineCoefficients::enclose() {
  for (std::size_t row = 0; row < equations_.size(); ++row) {
    if (!derive(equations_[row], row)) return false;
  }
  if (spec_->dynamics.time == Time::continuous) return exponentiate();
  phi_ = matrix_;
  return true;
}

/// Derivatives by all of A: the same everywhere, so taken over the whole domain.
bool AffineCoefficients::derive(std::size_t equation, std::size_t row) {
  const auto slot = [&](std::size_t j) { return spec_->state_slot(at(part_.states[j])); };
  Evaluator<Dual> evaluator(spec_->dynamics.equations[equation]);
  for (std::size_t first = 0; first < part_.states.size(); first += Dual::kDirections) {
    const std::size_t count = std::min(Dual::kDirections, part_.states.size() - first);
    for (std::size_t d = 0; d < count; ++d) {
      slots_[slot(first + d)] = Dual::variable(slots_[slot(first + d)].value, d);
    }
    const Dual& value = evaluator.number(slots_);
    for (std::size_t d = 0; d < count; ++d) {
      const Interval entry = d < value.directions ? value.gradient[d] : Interval{0.0, 0.0};
      if (!entry.is_finite()) return false;
      matrix_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(first + d)) = entry;
      slots_[slot(first + d)] = Dual::constant(slots_[slot(first + d)].value);
    }
  }
  return true;
}

/// Over a part of the period short enough for the series, then squared.
bool AffineCoefficients::exponentiate() {
  Interval period{lower_double(spec_->dynamics.period), upper_double(spec_->dynamics.period)};
  const double largest = magnitudes(matrix_).maxCoeff();
  int halvings = 0;
  while (largest * static_cast<double>(matrix_.rows()) * period.upper > kLongest) {
    if (++halvings > kMostHalvings) return false;
    period = period * Interval(0.5);
  }
  TransitionMatrix transition(part_.states.size(), TransitionMatrix::kManyTerms);
  if (!transition.enclose(matrix_, period, std::vector<bool>(part_.states.size(), false))) return false;
  phi_ = to_intervals(transition.end());
  for (; halvings > 0; --halvings) phi_ = product(phi_, phi_).eval();
  return is_finite(phi_);
}

}  // namespace coordreq
