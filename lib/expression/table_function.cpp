#include "expression/table_function.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "base/requires.hpp"
#include "expression/piecewise_linear.hpp"
#include "expression/tape_builder.hpp"

namespace coordreq {
namespace {

using Index = TapeBuilder::Index;

bool rises_or_falls(const PiecewiseLinear& f, std::size_t first, std::size_t last) {
  bool rises = true, falls = true;
  for (std::size_t i = first; i < last; ++i) {
    rises = rises && f.lines[i].slope >= 0;
    falls = falls && f.lines[i].slope <= 0;
  }
  return rises || falls;
}

/// The function between two of its ends, with the values there before and after.
PiecewiseLinear flat_beyond(const PiecewiseLinear& f, std::size_t first, std::size_t last) {
  std::vector<Rational> x, value;
  const auto add = [&](const Rational& point, std::size_t end) {
    x.push_back(point);
    value.push_back(f.at_end(end));
  };
  if (first > 0) add(f.ends.front(), first);
  for (std::size_t i = first; i <= last; ++i) add(f.ends[i], i);
  if (last < f.lines.size()) add(f.ends.back(), last);
  return through_points(x, value);
}

/// Writes tables as nodes. What makes no difference (times 1, plus 0) is left out, so that a table that says
/// the same as `abs`, `min` or `max` is the same.
class TableWriter {
 public:
  /// An argument as the table sees it.
  Index argument(std::uint32_t slot, std::span<const Rational> axis, BeyondAxis beyond) {
    const Index x = tape_.variable(slot);
    const Index first = tape_.constant(axis.front());
    const Index last = tape_.constant(axis.back());
    if (beyond == BeyondAxis::clamp) {
      return tape_.apply(Operator::maximum, tape_.apply(Operator::minimum, x, last), first);
    }
    const Index inside = tape_.apply(Operator::logical_and, tape_.apply(Operator::less_equal, first, x),
                                     tape_.apply(Operator::less_equal, x, last));
    // undefined_reason() knows this quotient for a table.
    const Index nothing = tape_.apply(Operator::divide, tape_.constant(0), tape_.constant(0));
    return tape_.apply(Operator::if_else, inside, x, nothing);
  }

  Index interpolated(Index x, std::span<const Rational> axis, std::span<const Rational> value) {
    const PiecewiseLinear f = through_points(axis, value);
    if (f.lines.size() == 2 && f.lines[0].slope == -f.lines[1].slope) {
      const Index distance = tape_.apply(Operator::absolute, plus(x, -f.ends[1]));
      return plus(times(f.lines[1].slope, distance), f.at_end(1));
    }
    return segment(f, 0, f.lines.size(), x);
  }

  Index plus(Index x, const Rational& number) {
    return number == 0 ? x : tape_.apply(Operator::add, x, tape_.constant(number));
  }
  Index sum(std::optional<Index> a, Index b) { return joined(Operator::add, a, b); }
  Index product(Index a, Index b) { return tape_.apply(Operator::multiply, a, b); }

  [[nodiscard]] TableFunction function(std::size_t arguments, Index result) const {
    return {arguments, tape_.extract(result)};
  }

 private:
  Index times(const Rational& number, Index x) {
    if (number == 0) return tape_.constant(0);
    if (number == 1) return x;
    if (number == -1) return tape_.apply(Operator::negate, x);
    return tape_.apply(Operator::multiply, tape_.constant(number), x);
  }

  Index joined(Operator op, std::optional<Index> a, Index b) { return a ? tape_.apply(op, *a, b) : b; }

  Index line(const Line& line, Index x) {
    return line.slope == 0 ? tape_.constant(line.offset) : plus(times(line.slope, x), line.offset);
  }

  /// The function between two of its ends, and beyond these as there. Where it is greatest within, it is the
  /// minimum of its two sides, and where it is least within, their maximum: ranges of both sides then give
  /// the range of the whole.
  Index segment(const PiecewiseLinear& f, std::size_t first, std::size_t last, Index x) {
    if (!rises_or_falls(f, first, last)) {
      const auto value = [&](std::size_t i) { return f.at_end(i); };
      Rational most = value(first), least = most;
      for (std::size_t i = first + 1; i <= last; ++i) {
        most = std::max<Rational>(most, value(i));
        least = std::min<Rational>(least, value(i));
      }
      for (const auto& [level, op] :
           {std::pair{most, Operator::minimum}, std::pair{least, Operator::maximum}}) {
        for (std::size_t i = first + 1; i < last; ++i) {
          if (value(i) == level) return tape_.apply(op, segment(f, first, i, x), segment(f, i, last, x));
        }
      }
    }
    const PiecewiseLinear extended = flat_beyond(f, first, last);
    std::optional<Index> greatest;
    for (const LeastLine& minimum : as_maximum_of_minima(extended))
      greatest = joined(Operator::maximum, greatest, least(extended, minimum, x));
    return *greatest;
  }

  Index least(const PiecewiseLinear& f, const LeastLine& minimum, Index x) {
    std::optional<Index> least;
    for (const std::size_t i : minimum.lines) least = joined(Operator::minimum, least, line(f.lines[i], x));
    return minimum.most ? joined(Operator::minimum, least, tape_.constant(*minimum.most)) : *least;
  }

  TapeBuilder tape_;
};

/// Half the sum of the least and the greatest value.
Rational middle_of(const std::vector<std::vector<Rational>>& rows) {
  Rational least = rows.front().front();
  Rational most = least;
  for (const std::vector<Rational>& row : rows) {
    const auto [low, high] = std::minmax_element(row.begin(), row.end());
    least = std::min(least, *low);
    most = std::max(most, *high);
  }
  return (least + most) / 2;
}

}  // namespace

TableFunction linear_table(std::span<const Rational> x, std::span<const Rational> value, BeyondAxis beyond) {
  REQUIRES(x.size() >= 2 && x.size() == value.size());
  REQUIRES(std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) == x.end());
  TableWriter writer;
  return writer.function(1, writer.interpolated(writer.argument(0, x, beyond), x, value));
}

TableFunction bilinear_table(std::span<const Rational> x, std::span<const Rational> y,
                             const std::vector<std::vector<Rational>>& rows, BeyondAxis beyond) {
  REQUIRES(y.size() >= 2 && y.size() == rows.size());
  REQUIRES(std::adjacent_find(y.begin(), y.end(), std::greater_equal<>()) == y.end());
  REQUIRES(x.size() >= 2 &&
           std::all_of(rows.begin(), rows.end(), [&](const auto& row) { return row.size() == x.size(); }));
  REQUIRES(std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) == x.end());
  TableWriter writer;
  const Index at_x = writer.argument(0, x, beyond);
  const Index at_y = writer.argument(1, y, beyond);
  const Rational middle = middle_of(rows);
  std::optional<Index> sum;
  for (std::size_t j = 0; j < y.size(); ++j) {
    std::vector<Rational> row = rows[j];
    for (Rational& value : row) value -= middle;
    std::vector<Rational> hat(y.size(), 0);
    hat[j] = 1;
    sum =
        writer.sum(sum, writer.product(writer.interpolated(at_x, x, row), writer.interpolated(at_y, y, hat)));
  }
  return writer.function(2, writer.plus(*sum, middle));
}

}  // namespace coordreq
