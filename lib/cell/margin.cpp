#include "cell/margin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coordreq {
namespace {

double margin_of(Operator op, double difference) {
  switch (op) {
    case Operator::less:
    case Operator::less_equal:
      return -difference;
    case Operator::equal:
      return -std::fabs(difference);
    case Operator::not_equal:
      return std::fabs(difference);
    default:
      return difference;
  }
}

/// NaN stands for an unknown margin: it decides nothing, so a negative partner is all that counts.
double smaller(double a, double b) {
  if (std::isnan(a)) return b < 0 ? b : a;
  if (std::isnan(b)) return a < 0 ? a : b;
  return std::min(a, b);
}

}  // namespace

Margin::Margin(const Program& condition) : formula_(std::make_unique<Formula>(take_apart(condition))) {
  for (const Formula::Comparison& comparison : formula_->comparisons) {
    differences_.emplace_back(comparison.difference);
  }
  difference_values_.resize(differences_.size());
  node_values_.resize(formula_->nodes.size());
}

double Margin::value(std::span<const Rational> slots) {
  for (std::size_t i = 0; i < differences_.size(); ++i) difference_values_[i] = differences_[i].value(slots);
  return of_differences(difference_values_);
}

double Margin::approximate(std::span<const double> slots) {
  for (std::size_t i = 0; i < differences_.size(); ++i) {
    difference_values_[i] = differences_[i].approximate(slots);
  }
  return of_differences(difference_values_);
}

double Margin::of_differences(std::span<const double> differences) {
  for (std::size_t i = 0; i < node_values_.size(); ++i) {
    const Formula::Node& node = formula_->nodes[i];
    double& value = node_values_[i];
    switch (node.op) {
      case Operator::logical_and:
        value = smaller(node_values_[node.a], node_values_[node.b]);
        break;
      case Operator::logical_or:
        value = -smaller(-node_values_[node.a], -node_values_[node.b]);
        break;
      case Operator::logical_not:
        value = -node_values_[node.a];
        break;
      case Operator::literal_true:
        value = outward::kInfinity;
        break;
      case Operator::literal_false:
        value = -outward::kInfinity;
        break;
      case Operator::literal_undecided:
        value = std::numeric_limits<double>::quiet_NaN();
        break;
      default:
        value = margin_of(formula_->comparisons[node.a].op, differences[node.a]);
    }
  }
  const double result = node_values_.back();
  return std::isnan(result) ? -outward::kInfinity : result + 0.0;  // no -0
}

}  // namespace coordreq
