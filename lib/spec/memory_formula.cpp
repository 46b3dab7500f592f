#include "spec/memory_formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "expression/place.hpp"
#include "expression/token.hpp"

namespace coordreq {
namespace {

constexpr int kDeepestCalls = 200;

class FormulaReader {
 public:
  FormulaReader(std::string_view text, std::string_view where) : source_{text, where} {}

  MemoryFormula run() {
    formula_.whole = segment(0, source_.text.size(), 0);
    return std::move(formula_);
  }

 private:
  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  FormulaSegment segment(std::size_t begin, std::size_t end, int depth) {
    FormulaSegment result{blank(source_.text), {}};
    std::size_t copied = begin;
    const auto copy_to = [&](std::size_t to) {
      std::copy(source_.text.begin() + static_cast<std::ptrdiff_t>(copied),
                source_.text.begin() + static_cast<std::ptrdiff_t>(to),
                result.text.begin() + static_cast<std::ptrdiff_t>(copied));
      copied = to;
    };
    for (std::size_t at = begin; at < end;) {
      const Token token = read_token(source_.text, at);
      if (token.offset >= end || token.kind == TokenKind::end) break;
      at = token.offset + token.text.size();
      if (token.kind != TokenKind::name || past_operator_arguments(token.text) == 0) continue;
      const std::vector<Range> arguments = arguments_of(at, end);
      if (arguments.empty()) continue;
      copy_to(token.offset);
      const std::string name = new_name();
      result.calls[name] = add_call(token, arguments, depth);
      at = arguments.back().end + 1;
      // Shorter than the call, whose name alone is.
      std::copy(name.begin(), name.end(), result.text.begin() + static_cast<std::ptrdiff_t>(token.offset));
      copied = at;
    }
    copy_to(end);
    return result;
  }

  /// A name that the text does not have, no longer than a call: "once(a)".
  std::string new_name() {
    std::string name;
    do name = "q" + std::to_string(names_++);
    while (source_.text.find(name) != std::string_view::npos);
    return name;
  }

  std::size_t add_call(const Token& token, const std::vector<Range>& arguments, int depth) {
    const std::size_t wanted = past_operator_arguments(token.text);
    if (arguments.size() != wanted) {
      source_.fail(fmt::format("{} takes {} argument{}, found {}", token.text, wanted, wanted == 1 ? "" : "s",
                               arguments.size()),
                   token.offset);
    }
    if (depth == kDeepestCalls)
      source_.fail(fmt::format("past operators are nested deeper than {} levels", kDeepestCalls),
                   token.offset);
    const std::size_t number = formula_.calls.size();
    formula_.calls.push_back({token.text, {}});
    for (const Range& argument : arguments) {
      FormulaSegment inner = segment(argument.begin, argument.end, depth + 1);
      formula_.calls[number].arguments.push_back(std::move(inner));
    }
    return number;
  }

  /// The arguments of a call whose name ends at `at`; none if no list in parentheses follows, which the
  /// parser will say.
  [[nodiscard]] std::vector<Range> arguments_of(std::size_t at, std::size_t end) const {
    Token token = read_token(source_.text, at);
    if (token.kind != TokenKind::open) return {};
    std::vector<Range> arguments{{token.offset + 1, 0}};
    int depth = 0;
    while (true) {
      token = read_token(source_.text, token.offset + token.text.size());
      if (token.kind == TokenKind::end) source_.fail("expected ')', found the end", token.offset);
      if (token.offset >= end) return {};
      if (token.kind == TokenKind::open) ++depth;
      const bool closes = token.kind == TokenKind::close && depth-- == 0;
      if (!closes && (token.kind != TokenKind::comma || depth > 0)) continue;
      arguments.back().end = token.offset;
      if (closes) return arguments;
      arguments.push_back({token.offset + 1, 0});
    }
  }

  static std::string blank(std::string_view text) {
    std::string result(text);
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c != '\n'; }, ' ');
    return result;
  }

  SourceText source_;
  int names_ = 0;
  MemoryFormula formula_;
};

}  // namespace

MemoryFormula take_apart_formula(std::string_view text, std::string_view where) {
  return FormulaReader(text, where).run();
}

}  // namespace coordreq
