#include "expression/syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "expression/functions.hpp"
#include "expression/other_names.hpp"
#include "expression/token.hpp"

namespace coordreq {
namespace {

constexpr int kDeepest = 1000;

/// How tightly operators bind, loosest first.
enum Precedence : int { kNone = 0, kOr, kAnd, kNot, kComparison, kSum, kProduct, kPower };

int binary_precedence(const Token& token) {
  if (token.kind != TokenKind::op) return kNone;
  if (is_comparison(token.op)) return kComparison;
  switch (token.op) {
    case Operator::logical_or:
      return kOr;
    case Operator::logical_and:
      return kAnd;
    case Operator::add:
    case Operator::subtract:
      return kSum;
    case Operator::multiply:
    case Operator::divide:
      return kProduct;
    case Operator::power:
      return kPower;
    default:
      return kNone;
  }
}

/// Precedence climbing by hand rather than a grammar in PEGTL: every error has to name what was found and
/// what could have stood there, and a level of nesting must cost little stack (a PEGTL level of this grammar
/// runs through some fifty frames, 1000 of which overflow 8 MiB under AddressSanitizer).
///
/// Functions with temporaries are out of line: inlined, those would be part of every frame of expression().
class Parser {
 public:
  Parser(const SourceText& source, const TableLookup& tables)
      : source_(source), tables_(tables), token_(read_token(source.text, 0)) {}

  SyntaxTree run() {
    expression(kOr);
    if (token_.kind != TokenKind::end) fail_expected("an operator or the end");
    return std::move(tree_);
  }

 private:
  /// Counts one level of nesting while it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kDeepest) parser_.fail_depth();
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  /// Reads operators that bind at least as tightly as `loosest`, and their operands.
  void expression(int loosest) {
    operand(loosest);
    while (true) {
      const int precedence = binary_precedence(token_);
      if (precedence == kNone || precedence < loosest) return;
      if (precedence == kComparison) {
        comparison_chain();
      } else if (precedence == kPower) {
        exponent();
      } else {
        left_associative(precedence);
      }
    }
  }

  void left_associative(int precedence) {
    const Operator op = token_.op;
    const std::size_t start = tree_.nodes.back().offset;
    advance();
    expression(precedence + 1);
    emit(op, 2, start);
  }

  void exponent() {
    const Level level(*this);
    const std::size_t start = tree_.nodes.back().offset;
    advance();
    expression(kPower);
    emit(Operator::power, 2, start);
  }

  [[gnu::noinline]] void comparison_chain() {
    const std::size_t start = tree_.nodes.back().offset;
    std::vector<Operator> comparisons;
    while (binary_precedence(token_) == kComparison) {
      comparisons.push_back(token_.op);
      advance();
      expression(kSum);
    }
    emit(comparisons.front(), comparisons.size() + 1, start, tree_.comparisons.size());
    tree_.comparisons.insert(tree_.comparisons.end(), comparisons.begin(), comparisons.end());
  }

  void operand(int loosest) {
    switch (token_.kind) {
      case TokenKind::number:
        return number();
      case TokenKind::name:
        return name();
      case TokenKind::open:
        return parenthesis();
      case TokenKind::op:
        return prefix(loosest);
      default:
        fail_operand();
    }
  }

  [[gnu::noinline]] void prefix(int loosest) {
    const Token op = token_;
    const bool is_not = op.op == Operator::logical_not && loosest <= kNot;
    if (!is_not && op.op != Operator::subtract && op.op != Operator::add) {
      fail_operand();
    }
    const Level level(*this);
    advance();
    expression(is_not ? kNot : kPower);
    if (is_not) return emit(Operator::logical_not, 1, op.offset);
    emit(op.op == Operator::subtract ? Operator::negate : Operator::add, 1, op.offset);
  }

  [[gnu::noinline]] void number() {
    const std::optional<Rational> value = parse_decimal(token_.text);
    if (!value) fail_number();
    emit(Operator::constant, 0, token_.offset, tree_.numbers.size());
    tree_.numbers.push_back(*value);
    advance();
  }

  [[gnu::noinline]] void name() {
    const Token name = token_;
    advance();
    if (name.text == "true") return emit(Operator::literal_true, 0, name.offset);
    if (name.text == "false") return emit(Operator::literal_false, 0, name.offset);
    const std::optional<Function> function = find_function(name.text);
    if (function) {
      const std::size_t arguments = arguments_of_call();
      if (arguments < function->fewest || arguments > function->most)
        fail_count(*function, arguments, name.offset);
      return emit(function->op, arguments, name.offset);
    }
    if (const TableFunction* const table = tables_.find(name.text); table != nullptr)
      return call_table(name, *table);
    if (token_.kind == TokenKind::open) fail_function(name);
    emit(Operator::variable, 0, name.offset, tree_.names.size());
    tree_.names.push_back(name.text);
  }

  void parenthesis() {
    const Level level(*this);
    const std::size_t start = token_.offset;
    advance();
    expression(kOr);
    if (token_.kind != TokenKind::close) fail_expected("an operator or ')'");
    advance();
    tree_.nodes.back().offset = start;
  }

  [[gnu::noinline]] void call_table(const Token& name, const TableFunction& table) {
    const std::size_t arguments = arguments_of_call();
    if (arguments != table.arguments)
      fail_count({name.text, Operator::variable, table.arguments, table.arguments}, arguments, name.offset);
    emit(Operator::variable, arguments, name.offset, tree_.names.size());
    tree_.names.push_back(name.text);
  }

  /// The arguments in parentheses. @returns how many there are
  std::size_t arguments_of_call() {
    const Level level(*this);
    if (token_.kind != TokenKind::open) fail_expected("'('");
    advance();
    std::size_t arguments = 0;
    while (token_.kind != TokenKind::close || arguments > 0) {
      expression(kOr);
      ++arguments;
      if (token_.kind == TokenKind::close) break;
      if (token_.kind != TokenKind::comma) fail_expected("an operator, ',' or ')'");
      advance();
    }
    advance();
    return arguments;
  }

  [[gnu::noinline]] void advance() { token_ = read_token(source_.text, token_.offset + token_.text.size()); }

  [[gnu::noinline]] void emit(Operator op, std::size_t operands, std::size_t start, std::size_t item = 0) {
    tree_.nodes.push_back(
        {op, static_cast<std::uint32_t>(operands), static_cast<std::uint32_t>(item), start});
  }

  [[noreturn, gnu::noinline]] void fail_depth() const {
    source_.fail(fmt::format("the expression is nested deeper than {} levels", kDeepest), token_.offset);
  }

  [[noreturn, gnu::noinline]] void fail_operand() const {
    source_.fail(
        fmt::format("expected a number, a name or '(', found {}{}", token_text(token_), operand_hint()),
        token_.offset);
  }

  /// For those who write |v| as in mathematics.
  [[nodiscard]] std::string operand_hint() const {
    if (token_.text != "|" && token_.text != "||") return hint();
    const std::size_t start = token_.offset + 1;
    const std::size_t end = source_.text.find('|', start);
    const std::string_view inside = source_.text.substr(start, std::min(end, source_.text.size()) - start);
    const bool is_plain =
        end != std::string_view::npos && !inside.empty() &&
        std::all_of(inside.begin(), inside.end(), [](char c) { return c >= ' ' && c <= '~'; });
    return fmt::format(", did you mean {}?",
                       in_quotes(is_plain ? fmt::format("abs({})", inside) : "abs(...)"));
  }

  [[noreturn, gnu::noinline]] void fail_expected(std::string_view expected) const {
    source_.fail(fmt::format("expected {}, found {}{}", expected, token_text(token_), hint()), token_.offset);
  }

  /// For those who write another language.
  [[nodiscard]] std::string hint() const {
    if (token_.kind == TokenKind::unknown && (static_cast<unsigned char>(token_.text.front()) & 0x80U) != 0)
      return suggested_sign(token_.text);
    if (token_.text == "=") return std::string(equals_hint());
    if (token_.text == "&") return ", did you mean '&&'?";
    if (token_.text == "|") return ", did you mean '||'?";
    if (token_.text == "%") return ", did you mean 'mod(a, b)'?";
    const bool is_second_star =
        token_.text == "*" && token_.offset > 0 && source_.text[token_.offset - 1] == '*';
    return is_second_star ? ", did you mean '^'?" : "";
  }

  /// The hint for a '=' by itself, as in "x => 1".
  [[nodiscard]] std::string_view equals_hint() const {
    const std::string_view rest = source_.text.substr(token_.offset + 1);
    if (rest.starts_with('>')) return ", did you mean '>='?";
    return rest.starts_with('<') ? ", did you mean '<='?" : ", did you mean '=='?";
  }

  [[noreturn, gnu::noinline]] void fail_number() const {
    source_.fail(fmt::format("the number {} is out of range", in_quotes(token_.text)), token_.offset);
  }

  [[noreturn, gnu::noinline]] void fail_function(const Token& name) const {
    if (past_operator_arguments(name.text) > 0) {
      source_.fail(fmt::format("{} looks at the past, expected it in a formula of 'memory' only",
                               in_quotes(name.text)),
                   name.offset);
    }
    std::string suggestion = suggested_function(name.text);
    if (suggestion.empty()) suggestion = tables_.hint(name.text);
    if (!suggestion.empty())
      source_.fail(fmt::format("{} is not a function{}", in_quotes(name.text), suggestion), name.offset);
    std::string known = fmt::format("{}, {}", spelling(Operator::if_else), spelling(Operator::modulo));
    for (const NumberFunction& function : number_functions()) {
      if (!function.call.empty()) known += fmt::format(", {}", function.call);
    }
    source_.fail(fmt::format("{} is not a function, expected one of {}", in_quotes(name.text), known),
                 name.offset);
  }

  [[noreturn, gnu::noinline]] void fail_count(const Function& function, std::size_t found,
                                              std::size_t start) const {
    const std::string_view more = function.most > function.fewest ? " or more" : "";
    const std::string_view plural = function.most == 1 ? "" : "s";
    source_.fail(fmt::format("{} takes {}{} argument{}, found {}", function.name, function.fewest, more,
                             plural, found),
                 start);
  }

  const SourceText& source_;
  const TableLookup& tables_;
  Token token_;
  SyntaxTree tree_;
  int depth_ = 0;
};

}  // namespace

SyntaxTree parse(const SourceText& source, const TableLookup& tables) {
  return Parser(source, tables).run();
}

}  // namespace coordreq
