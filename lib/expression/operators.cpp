#include "expression/operators.hpp"

#include <array>
#include <cstddef>

namespace coordreq {
namespace {

// In the order of the enumeration.
constexpr std::array<std::string_view, 36> kSpellings{
    "number", "name", "+",    "-",    "*",    "/",    "^",    "min", "max", "-",    "sin",  "cos",
    "tan",    "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt", "abs",  "sign",
    "if",     "<",    "<=",   ">",    ">=",   "==",   "!=",   "and", "or",  "not",  "true", "false"};
static_assert(kSpellings.size() == static_cast<std::size_t>(Operator::literal_false) + 1);

}  // namespace

std::string_view spelling(Operator op) {
  return kSpellings[static_cast<std::size_t>(op)];
}

}  // namespace coordreq
