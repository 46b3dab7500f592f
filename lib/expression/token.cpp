#include "expression/token.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "expression/functions.hpp"
#include "expression/place.hpp"

namespace coordreq {
namespace {

// Longer symbols first, so that `<=` is not read as `<`.
constexpr std::array kSymbols{
    std::pair{std::string_view("<="), Operator::less_equal},
    std::pair{std::string_view(">="), Operator::greater_equal},
    std::pair{std::string_view("=="), Operator::equal},
    std::pair{std::string_view("!="), Operator::not_equal},
    std::pair{std::string_view("&&"), Operator::logical_and},
    std::pair{std::string_view("||"), Operator::logical_or},
    std::pair{std::string_view("<"), Operator::less},
    std::pair{std::string_view(">"), Operator::greater},
    std::pair{std::string_view("!"), Operator::logical_not},
    std::pair{std::string_view("+"), Operator::add},
    std::pair{std::string_view("-"), Operator::subtract},
    std::pair{std::string_view("*"), Operator::multiply},
    std::pair{std::string_view("/"), Operator::divide},
    std::pair{std::string_view("^"), Operator::power},
};

// The C library's classifications depend on the locale.
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_name_character(char c) {
  return is_name_start(c) || is_digit(c);
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

template <class Predicate>
std::size_t run_length(std::string_view text, Predicate predicate) {
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), predicate) - text.begin());
}

/// Length of the decimal literal at the start of `text`, 0 if there is none.
std::size_t number_length(std::string_view text) {
  std::size_t length = run_length(text, is_digit);
  std::size_t digits = length;
  if (length < text.size() && text[length] == '.') {
    const std::size_t fraction = run_length(text.substr(length + 1), is_digit);
    digits += fraction;
    length += 1 + fraction;
  }
  if (digits == 0) return 0;
  std::size_t exponent = length;
  if (exponent == text.size() || (text[exponent] != 'e' && text[exponent] != 'E')) return length;
  ++exponent;
  if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
  const std::size_t exponent_digits = run_length(text.substr(exponent), is_digit);
  return exponent_digits == 0 ? length : exponent + exponent_digits;
}

Token name_token(std::string_view name, std::size_t offset) {
  if (name == "and") return {TokenKind::op, Operator::logical_and, offset, name};
  if (name == "or") return {TokenKind::op, Operator::logical_or, offset, name};
  if (name == "not") return {TokenKind::op, Operator::logical_not, offset, name};
  return {TokenKind::name, Operator::variable, offset, name};
}

Token symbol_token(std::string_view rest, std::size_t offset) {
  switch (rest.front()) {
    case '(':
      return {TokenKind::open, Operator::constant, offset, rest.substr(0, 1)};
    case ')':
      return {TokenKind::close, Operator::constant, offset, rest.substr(0, 1)};
    case ',':
      return {TokenKind::comma, Operator::constant, offset, rest.substr(0, 1)};
    default:
      break;
  }
  for (const auto& [symbol, op] : kSymbols) {
    if (rest.substr(0, symbol.size()) == symbol)
      return {TokenKind::op, op, offset, rest.substr(0, symbol.size())};
  }
  return {TokenKind::unknown, Operator::constant, offset, rest.substr(0, code_point_size(rest))};
}

}  // namespace

Token read_token(std::string_view text, std::size_t offset) {
  offset += run_length(text.substr(offset), is_space);
  const std::string_view rest = text.substr(offset);
  if (rest.empty()) return {TokenKind::end, Operator::constant, offset, rest};
  if (const std::size_t length = number_length(rest); length > 0) {
    return {TokenKind::number, Operator::constant, offset, rest.substr(0, length)};
  }
  if (is_name_start(rest.front()))
    return name_token(rest.substr(0, run_length(rest, is_name_character)), offset);
  return symbol_token(rest, offset);
}

std::string token_text(const Token& token) {
  if (token.kind == TokenKind::end) return "the end";
  if (token.kind == TokenKind::unknown) return character_text(token.text);
  return in_quotes(token.text);
}

std::size_t past_operator_arguments(std::string_view name) {
  if (name == "once" || name == "always" || name == "previous") return 1;
  return name == "since" || name == "within" || name == "for_last" ? 2 : 0;
}

std::optional<Function> find_function(std::string_view name) {
  if (name == spelling(Operator::if_else)) return Function{name, Operator::if_else, 3, 3};
  if (name == spelling(Operator::modulo)) return Function{name, Operator::modulo, 2, 2};
  for (const NumberFunction& function : number_functions()) {
    if (!function.call.empty() && function.call == name)
      return Function{function.call, function.op, function.fewest, function.most};
  }
  return std::nullopt;
}

}  // namespace coordreq
