#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "expression/operators.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// An expression that is parsed, type-checked and linked: a directed acyclic graph stored as a tape.
///
/// Invariants: operands stand before the nodes that use them; the last node is the result; equal
/// sub-expressions are stored once, so that nested definitions cannot blow up; nodes not needed for the
/// result are absent. Immutable after linking, so safe to share between threads.
struct Program {
  struct Node {
    Operator op;
    std::uint32_t a =
        0;  ///< first operand; for `constant` the index into `constants`; for `variable` the slot
    std::uint32_t b = 0;
    std::uint32_t c = 0;
  };
  std::vector<Node> nodes;
  std::vector<Rational> constants;  ///< exact: `pi` and other irrational constants stay function nodes where
                                    ///< exactness matters; see link()
  std::string text;                 ///< as written in the spec, for messages

  [[nodiscard]] bool is_condition() const { return coordreq::is_condition(nodes.back().op); }
  /// Slots that the result depends on, ascending, each once.
  [[nodiscard]] std::vector<std::uint32_t> variables() const;
};

/// A name that stands for nothing.
struct NotDefined {
  std::string hint = {};  ///< for the end of the message, perhaps ", did you mean 'v1'?"
};

/// The meaning of a name in an expression.
using Binding = std::variant<NotDefined,
                             std::uint32_t,                    ///< a variable: its slot
                             Rational,                         ///< a constant
                             std::shared_ptr<const Program>>;  ///< a definition, inlined
using Lookup = std::function<Binding(std::string_view name)>;

enum class ExpectedType : std::uint8_t { number, condition, any };

/// Parses and links `text`.
/// `pi` is the double nearest to pi, exact from then on (contract: an irrational constant is its correctly
/// rounded double). Names that are functions or keywords (see reserved_names()) are never looked up.
/// Chains `a < b <= c` mean (a < b) and (b <= c).
/// @throws SpecError with `where` extended by the place: "/safe, column 8", or "line 2, column 3" if the text
///   has several lines. Found and expected are named. Also on nesting deeper than 1000.
[[nodiscard]] Program link(std::string_view text, const Lookup& lookup, ExpectedType expected,
                           std::string_view where);

/// The names that `text` mentions and that are neither functions nor keywords, each once, in order of
/// appearance; for ordering definitions. @throws SpecError as link() does for syntax errors.
[[nodiscard]] std::vector<std::string> mentioned_names(std::string_view text, std::string_view where);

/// Functions and keywords: no state, constant or definition may be called so.
[[nodiscard]] bool is_reserved_name(std::string_view name);

/// Exact value of a constant expression (contract, "Grid"): rational operations are exact, an irrational
/// value is its correctly rounded double. @throws SpecError if it is undefined, not finite or no number.
[[nodiscard]] Rational constant_value(const Program& program, std::string_view where);

}  // namespace coordreq
