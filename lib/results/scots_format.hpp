#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/reversed_numbers.hpp"
#include "numeric/rational.hpp"

// The text of a static controller of SCOTS v0.2, in the order in which it stands in the file: the head, the
// two grids, the matrix of cells and their valid inputs. Who reads and who writes it agree here.
namespace coordreq::scots {

inline constexpr std::string_view kHead[] = {"#SCOTS:v0.2", "#TYPE:STATICCONTROLLER"};
/// A grid follows each of them.
inline constexpr std::string_view kStates = "#SCOTS:STATE_SPACE";
inline constexpr std::string_view kInputs = "#SCOTS:INPUT_SPACE";

inline constexpr std::string_view kGrid = "#TYPE:UNIFORMGRID";
inline constexpr std::string_view kDimensions = "#MEMBER:DIM";
/// A vector is its name, kBegin with its length, a number a line, kEnd.
inline constexpr std::string_view kSteps = "#VECTOR:ETA";
inline constexpr std::string_view kFirsts = "#VECTOR:LOWER_LEFT";
inline constexpr std::string_view kLasts = "#VECTOR:UPPER_RIGHT";

inline constexpr std::string_view kDomain = "#TYPE:WINNINGDOMAIN";
/// There may be a line that explains the matrix, which begins with kComment.
inline constexpr std::string_view kComment = "#SCOTS:";
inline constexpr std::string_view kColumns = "#SCOTS:i (state) j_0 ... j_n (valid inputs)";
/// Then kBegin with the numbers of cells and of joint inputs, a line a cell, kEnd. With 1 instead of the
/// number of joint inputs each line names the one input of its cell (a reachability game); with more any
/// number of them.
inline constexpr std::string_view kMatrix = "#MATRIX:DATA";
inline constexpr std::string_view kBegin = "#BEGIN:";
inline constexpr std::string_view kEnd = "#END";

/// One dimension of a grid.
struct Axis {
  std::string name;
  Rational first;
  Rational last;
  Rational step;
  std::int64_t count = 0;
};

/// Cells and joint inputs are numbered with dimension 0 fastest.
template <class AnyAxis>
[[nodiscard]] ReversedNumbers numbers(const std::vector<AnyAxis>& axes) {
  std::vector<std::int64_t> counts;
  for (const AnyAxis& axis : axes) counts.push_back(axis.count);
  return ReversedNumbers(counts);
}

}  // namespace coordreq::scots
