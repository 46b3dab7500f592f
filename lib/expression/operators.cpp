#include "expression/operators.hpp"

#include "expression/functions.hpp"

namespace coordreq {

std::string_view spelling(Operator op) {
  if (is_number_function(op)) return number_function(op).spelling;
  switch (op) {
    case Operator::constant:
      return "number";
    case Operator::variable:
      return "name";
    case Operator::modulo:
      return "mod";
    case Operator::if_else:
      return "if";
    case Operator::less:
      return "<";
    case Operator::less_equal:
      return "<=";
    case Operator::greater:
      return ">";
    case Operator::greater_equal:
      return ">=";
    case Operator::equal:
      return "==";
    case Operator::not_equal:
      return "!=";
    case Operator::logical_and:
      return "and";
    case Operator::logical_or:
      return "or";
    case Operator::logical_not:
      return "not";
    case Operator::literal_true:
      return "true";
    case Operator::literal_undecided:
      return "undecided";
    default:
      return "false";
  }
}

}  // namespace coordreq
