#include "verify/affine_form.hpp"

#include <flint/fmpq_mpoly.h>

#include <algorithm>
#include <utility>

#include "expression/domains.hpp"
#include "expression/exact_equations.hpp"
#include "expression/truth_of.hpp"
#include "verify/arb.hpp"

namespace coordreq {
namespace {

class Context {
 public:
  explicit Context(std::size_t variables) {
    fmpq_mpoly_ctx_init(context_, static_cast<slong>(variables), ORD_LEX);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { fmpq_mpoly_ctx_clear(context_); }
  [[nodiscard]] const fmpq_mpoly_ctx_struct* get() const { return context_; }

 private:
  fmpq_mpoly_ctx_t context_;
};

class Form {
 public:
  explicit Form(const Context& context) : context_(context.get()) { fmpq_mpoly_init(form_, context_); }
  Form(const Context& context, const Rational& value) : Form(context) {
    fmpq_mpoly_set_fmpq(form_, FlintRational(value).get(), context_);
  }
  Form(const Form& other) : context_(other.context_) {
    fmpq_mpoly_init(form_, context_);
    fmpq_mpoly_set(form_, other.form_, context_);
  }
  Form& operator=(Form other) noexcept {
    fmpq_mpoly_swap(form_, other.form_, context_);
    return *this;
  }
  ~Form() { fmpq_mpoly_clear(form_, context_); }

  [[nodiscard]] fmpq_mpoly_struct* get() { return form_; }
  [[nodiscard]] const fmpq_mpoly_struct* get() const { return form_; }
  [[nodiscard]] std::optional<Rational> constant() const {
    if (fmpq_mpoly_is_fmpq(form_, context_) == 0) return std::nullopt;
    FlintRational value;
    fmpq_mpoly_get_fmpq(value.get(), form_, context_);
    return value.value();
  }

 private:
  const fmpq_mpoly_ctx_struct* context_;
  fmpq_mpoly_t form_;
};

RationalInterval point_of(const Rational& q) {
  return {.lower = q, .upper = q};
}

class Multiplier {
 public:
  Multiplier(const Program& program, const std::vector<std::uint32_t>& variables,
             const std::vector<Rational>& values)
      : program_(program), variables_(variables), values_(values), context_(variables.size()) {}

  std::optional<ExactForm> run() {
    forms_.assign(program_.nodes.size(), std::nullopt);
    truths_.assign(program_.nodes.size(), Truth::undecided);
    for (std::size_t n = 0; n < program_.nodes.size(); ++n) {
      const Program::Node& node = program_.nodes[n];
      if (is_condition(node.op)) {
        truths_[n] = truth_of(node, truths_, [&] { return comparison(node); });
      } else {
        forms_[n] = number(node);
      }
    }
    if (!forms_.back() || fmpq_mpoly_total_degree_si(forms_.back()->get(), context_.get()) > 1)
      return std::nullopt;
    ExactForm result;
    std::vector<ulong> exponents(variables_.size() + 1, 0);
    const auto coefficient = [&] {
      FlintRational value;
      fmpq_mpoly_get_coeff_fmpq_ui(value.get(), forms_.back()->get(), exponents.data(), context_.get());
      return value.value();
    };
    result.constant = coefficient();
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      exponents[j] = 1;
      result.slope.push_back(coefficient());
      exponents[j] = 0;
    }
    return result;
  }

 private:
  [[nodiscard]] std::optional<Form> number(const Program::Node& node) const {
    if (node.op == Operator::constant) return Form(context_, program_.constants[node.a]);
    if (node.op == Operator::variable) return variable(node.a);
    if (node.op == Operator::if_else) return choice(node);
    const std::optional<Form>& a = forms_[node.a];
    if (!a) return std::nullopt;
    if (is_unary_function(node.op)) return unary(node.op, *a);
    const std::optional<Form>& b = forms_[node.b];
    return b ? binary(node.op, *a, *b) : std::nullopt;
  }

  [[nodiscard]] Form variable(std::uint32_t slot) const {
    const auto found = std::find(variables_.begin(), variables_.end(), slot);
    if (found == variables_.end()) return {context_, values_[slot]};
    Form result(context_);
    fmpq_mpoly_gen(result.get(), found - variables_.begin(), context_.get());
    return result;
  }

  [[nodiscard]] std::optional<Form> known(const RationalInterval& value) const {
    if (!value.is_point() || !value.total) return std::nullopt;
    return Form(context_, value.lower);
  }

  [[nodiscard]] std::optional<Form> unary(Operator op, const Form& a) const {
    if (op == Operator::negate) {
      Form result(context_);
      fmpq_mpoly_neg(result.get(), a.get(), context_.get());
      return result;
    }
    const std::optional<Rational> value = a.constant();
    return value ? known(apply(op, point_of(*value))) : std::nullopt;
  }

  [[nodiscard]] std::optional<Form> binary(Operator op, const Form& a, const Form& b) const {
    const std::optional<Rational> left = a.constant();
    const std::optional<Rational> right = b.constant();
    if (left && right) return known(apply(op, point_of(*left), point_of(*right)));
    Form result(context_);
    switch (op) {
      case Operator::add:
        fmpq_mpoly_add(result.get(), a.get(), b.get(), context_.get());
        return result;
      case Operator::subtract:
        fmpq_mpoly_sub(result.get(), a.get(), b.get(), context_.get());
        return result;
      case Operator::multiply:
        return product(a, b);
      case Operator::divide:
        if (!right || *right == 0) return std::nullopt;
        fmpq_mpoly_scalar_div_fmpq(result.get(), a.get(), FlintRational(*right).get(), context_.get());
        return result;
      case Operator::power:
        if (!right || !is_integer(*right) || *right < 0 || *right > kMostDegreeOfExact) return std::nullopt;
        return power(a, right->get_num().get_ui());
      default:
        return std::nullopt;
    }
  }

  /// Number of terms without the constant.
  [[nodiscard]] std::size_t terms_of(const Form& a) const {
    const std::vector<ulong> none(variables_.size() + 1, 0);
    FlintRational constant;
    fmpq_mpoly_get_coeff_fmpq_ui(constant.get(), a.get(), none.data(), context_.get());
    const auto length = static_cast<std::size_t>(fmpq_mpoly_length(a.get(), context_.get()));
    return length - (constant.value() != 0 ? 1 : 0);
  }

  [[nodiscard]] std::optional<Form> product(const Form& a, const Form& b) const {
    if (!a.constant() && !b.constant()) {
      const slong degree = fmpq_mpoly_total_degree_si(a.get(), context_.get()) +
                           fmpq_mpoly_total_degree_si(b.get(), context_.get());
      if (degree > slong{kMostDegreeOfExact} || terms_of(a) * terms_of(b) > kMostTermsOfExact)
        return std::nullopt;
    }
    Form result(context_);
    fmpq_mpoly_mul(result.get(), a.get(), b.get(), context_.get());
    return result;
  }

  [[nodiscard]] std::optional<Form> power(const Form& base, unsigned long exponent) const {
    std::optional<Form> result = Form(context_, Rational(1));
    for (unsigned long i = 0; i < exponent && result; ++i) result = product(*result, base);
    return result;
  }

  [[nodiscard]] std::optional<Form> choice(const Program::Node& node) const {
    const std::optional<Form>& yes = forms_[node.b];
    const std::optional<Form>& no = forms_[node.c];
    if (truths_[node.a] == Truth::undecided) return std::nullopt;
    return truths_[node.a] == Truth::yes ? yes : no;
  }

  /// Decided where the difference is constant.
  [[nodiscard]] Truth comparison(const Program::Node& node) const {
    if (!forms_[node.a] || !forms_[node.b]) return Truth::undecided;
    Form difference(context_);
    fmpq_mpoly_sub(difference.get(), forms_[node.a]->get(), forms_[node.b]->get(), context_.get());
    const std::optional<Rational> value = difference.constant();
    return value ? compare(node.op, point_of(*value), point_of(0)) : Truth::undecided;
  }

  const Program& program_;
  const std::vector<std::uint32_t>& variables_;
  const std::vector<Rational>& values_;
  Context context_;
  std::vector<std::optional<Form>> forms_;
  std::vector<Truth> truths_;
};

}  // namespace

std::optional<ExactForm> affine_form(const Program& program, const std::vector<std::uint32_t>& variables,
                                     const std::vector<Rational>& values) {
  return Multiplier(program, variables, values).run();
}

}  // namespace coordreq
