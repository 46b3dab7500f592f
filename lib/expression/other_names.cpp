#include "expression/other_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "expression/functions.hpp"

namespace coordreq {
namespace {

struct OtherName {
  std::string_view other;  ///< in small letters
  std::string_view name;
};

constexpr std::array kOtherFunctions = {
    OtherName{"ln", "log"},
    OtherName{"log10", "log(x)/log(10)"},
    OtherName{"lg", "log(x)/log(10)"},
    OtherName{"log2", "log(x)/log(2)"},
    OtherName{"log1p", "log(1 + x)"},
    OtherName{"expm1", "exp(x) - 1"},
    OtherName{"fabs", "abs"},
    OtherName{"norm", "abs"},
    OtherName{"arcsin", "asin"},
    OtherName{"arccos", "acos"},
    OtherName{"arctan", "atan"},
    OtherName{"arctg", "atan"},
    OtherName{"arctan2", "atan2"},
    OtherName{"tg", "tan"},
    OtherName{"cot", "1/tan(x)"},
    OtherName{"sec", "1/cos(x)"},
    OtherName{"csc", "1/sin(x)"},
    OtherName{"sgn", "sign"},
    OtherName{"signum", "sign"},
    OtherName{"power", "pow"},
    OtherName{"square", "x^2"},
    OtherName{"sqr", "x^2"},
    OtherName{"cbrt", "sign(x)*abs(x)^(1/3)"},
    OtherName{"hypot", "sqrt(x^2 + y^2)"},
    OtherName{"ceil", "-floor(-x)"},
    OtherName{"ceiling", "-floor(-x)"},
    OtherName{"round", "floor(x + 0.5)"},
    OtherName{"fmod", "mod"},
    OtherName{"rem", "mod"},
    OtherName{"fmin", "min"},
    OtherName{"minimum", "min"},
    OtherName{"fmax", "max"},
    OtherName{"maximum", "max"},
    OtherName{"ite", "if"},
    OtherName{"ifelse", "if"},
    OtherName{"where", "if"},
    OtherName{"heaviside", "if(x > 0, 1, 0)"},
};

/// Signs of mathematics beyond ASCII.
constexpr std::array kOtherSigns = {
    OtherName{"\u2264", "<="},      OtherName{"\u2A7D", "<="},  OtherName{"\u2265", ">="},
    OtherName{"\u2A7E", ">="},      OtherName{"\u2260", "!="},  OtherName{"\u2227", "and"},
    OtherName{"\u2228", "or"},      OtherName{"\u00AC", "not"}, OtherName{"\u00D7", "*"},
    OtherName{"\u00B7", "*"},       OtherName{"\u22C5", "*"},   OtherName{"\u2212", "-"},
    OtherName{"\u2013", "-"},       OtherName{"\u00F7", "/"},   OtherName{"\u03C0", "pi"},
    OtherName{"\u221A", "sqrt(x)"}, OtherName{"\u00B2", "^2"},  OtherName{"\u00B3", "^3"},
};

constexpr std::array kOtherConstants = {
    OtherName{"pi", "pi"},      OtherName{"m_pi", "pi"},   OtherName{"e", "exp(1)"},
    OtherName{"m_e", "exp(1)"}, OtherName{"true", "true"}, OtherName{"false", "false"},
};

std::string in_small_letters(std::string_view name) {
  std::string result(name);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

template <class Names>
std::string suggestion(const Names& names, std::string_view name) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const OtherName& each) { return each.other == name; });
  return found == names.end() ? std::string() : fmt::format(", did you mean '{}'?", found->name);
}

}  // namespace

std::string suggested_function(std::string_view name) {
  const std::string small = in_small_letters(name);
  const auto functions = number_functions();
  const bool is_known = small == spelling(Operator::if_else) || small == spelling(Operator::modulo) ||
                        std::any_of(functions.begin(), functions.end(), [&](const NumberFunction& function) {
                          return !function.call.empty() && function.call == small;
                        });
  if (is_known && small != name) return fmt::format(", did you mean '{}'?", small);
  return suggestion(kOtherFunctions, small);
}

std::string suggested_sign(std::string_view sign) {
  return suggestion(kOtherSigns, sign);
}

std::string suggested_constant(std::string_view name) {
  return suggestion(kOtherConstants, in_small_letters(name));
}

}  // namespace coordreq
