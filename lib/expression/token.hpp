#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "expression/operators.hpp"

namespace coordreq {

enum class TokenKind : std::uint8_t {
  number,
  name,   ///< also functions and keywords that are no operators
  op,     ///< an operator; `-` is `subtract`, whatever it turns out to mean
  open,   ///< (
  close,  ///< )
  comma,
  end,
  unknown,  ///< a character that can stand nowhere
};

struct Token {
  TokenKind kind = TokenKind::end;
  Operator op = Operator::constant;  ///< for TokenKind::op
  std::size_t offset = 0;
  std::string_view text;
};

/// The first token at or after byte `offset` of `text`.
[[nodiscard]] Token read_token(std::string_view text, std::size_t offset);

/// The token as a message names what was found: "'x1'", "the end", "U+00E9".
[[nodiscard]] std::string token_text(const Token& token);

/// A function of the grammar, and how many arguments a call has.
struct Function {
  std::string_view name;
  Operator op;
  std::size_t fewest;
  std::size_t most;
};
[[nodiscard]] std::optional<Function> find_function(std::string_view name);

/// Number of arguments of an operator on the past; 0 if `name` is none. These operators stand only in
/// formulas of memories, which are taken apart before they are parsed, so that their names are free for other
/// things.
[[nodiscard]] std::size_t past_operator_arguments(std::string_view name);

}  // namespace coordreq
