#include "expression/piecewise_linear.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// For each piece whether something holds there.
using Pieces = std::vector<bool>;

std::size_t count_of_both(const Pieces& a, const Pieces& b) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] && b[k] ? std::size_t{1} : 0;
  return count;
}

/// Finds lines that cut a first one off wherever it is above the function.
class Lattice {
 public:
  explicit Lattice(const PiecewiseLinear& f) : f_(f) {
    for (const Line& line : f.lines) below_.push_back(pieces_below(line));
  }

  [[nodiscard]] std::vector<LeastLine> find() const {
    std::vector<LeastLine> minima;
    for (std::size_t j = 0; j < f_.lines.size(); ++j) {
      LeastLine minimum{cut_off(f_.lines[j], f_.ends[j], f_.ends[j + 1]), std::nullopt};
      insert(minimum.lines, j);
      if (turns(minimum)) minimum.most = greatest(minimum);
      minima.push_back(std::move(minimum));
    }
    remove_needless(minima);
    for (std::size_t i = 1; i < f_.lines.size(); ++i) {
      if (f_.lines[i - 1].slope < 0 && f_.lines[i].slope > 0) minima.push_back(floor_at(i));
    }
    return minima;
  }

 private:
  static void insert(std::vector<std::size_t>& lines, std::size_t line) {
    const auto position = std::lower_bound(lines.begin(), lines.end(), line);
    if (position == lines.end() || *position != line) lines.insert(position, line);
  }

  /// Where a line is nowhere above the function.
  [[nodiscard]] Pieces pieces_below(const Line& line) const {
    Pieces below;
    for (std::size_t k = 0; k < f_.lines.size(); ++k) {
      below.push_back(line.at(f_.ends[k]) <= f_.at_end(k) && line.at(f_.ends[k + 1]) <= f_.at_end(k + 1));
    }
    return below;
  }

  /// Lines that are at least `line` from `first` to `last`, so that the minimum of all is `line` there and
  /// nowhere above the function. A continuous function that is `line` there has them: where it is below
  /// `line`, one of its pieces on the way comes from above. @pre the function is at least `line` there
  [[nodiscard]] std::vector<std::size_t> cut_off(const Line& line, const Rational& first,
                                                 const Rational& last) const {
    std::vector<bool> may_cut;
    for (const Line& other : f_.lines) {
      may_cut.push_back(other.at(first) >= line.at(first) && other.at(last) >= line.at(last));
    }
    Pieces above = pieces_below(line);
    above.flip();
    std::vector<std::size_t> lines;
    while (std::find(above.begin(), above.end(), true) != above.end()) {
      std::size_t best = 0, most = 0;
      for (std::size_t i = 0; i < f_.lines.size(); ++i) {
        const std::size_t count = may_cut[i] ? count_of_both(above, below_[i]) : 0;
        if (count > most) best = i;
        most = std::max(most, count);
      }
      if (most == 0) throw std::logic_error("no line cuts off a line of a table");
      insert(lines, best);
      for (std::size_t k = 0; k < above.size(); ++k) above[k] = above[k] && !below_[best][k];
    }
    return lines;
  }

  [[nodiscard]] bool turns(const LeastLine& minimum) const {
    const auto has = [&](int side) {
      return std::any_of(minimum.lines.begin(), minimum.lines.end(),
                         [&](std::size_t i) { return sgn(f_.lines[i].slope) == side; });
    };
    return has(1) && has(-1);
  }

  [[nodiscard]] Rational value(const LeastLine& minimum, const Rational& x) const {
    Rational least = f_.lines[minimum.lines.front()].at(x);
    for (const std::size_t i : minimum.lines) least = std::min(least, f_.lines[i].at(x));
    return least;
  }

  /// The greatest value of a minimum of lines: at an end of the interval or where two of them meet.
  [[nodiscard]] Rational greatest(const LeastLine& minimum) const {
    Rational most = std::max(value(minimum, f_.ends.front()), value(minimum, f_.ends.back()));
    for (const std::size_t i : minimum.lines) {
      for (const std::size_t j : minimum.lines) {
        const Line& one = f_.lines[i];
        const Line& other = f_.lines[j];
        if (one.slope >= 0 || other.slope <= 0) continue;
        const Rational meeting = (other.offset - one.offset) / (one.slope - other.slope);
        if (f_.ends.front() < meeting && meeting < f_.ends.back())
          most = std::max(most, value(minimum, meeting));
      }
    }
    return most;
  }

  /// The value at a kink where the function turns upward, cut off where the function is below it.
  [[nodiscard]] LeastLine floor_at(std::size_t kink) const {
    const Rational level = f_.at_end(kink);
    std::size_t first = kink, last = kink;  // ends between which the function is at least that
    while (first > 0 && f_.at_end(first - 1) >= level) --first;
    while (last + 1 < f_.ends.size() && f_.at_end(last + 1) >= level) ++last;
    const auto crossing = [&](std::size_t piece) -> Rational {
      return (level - f_.lines[piece].offset) / f_.lines[piece].slope;
    };
    const Rational from = first == 0 ? f_.ends.front() : crossing(first - 1);
    const Rational to = last + 1 == f_.ends.size() ? f_.ends.back() : crossing(last);
    return {cut_off({0, level}, from, to), level};
  }

  /// A minimum of more lines is nowhere greater.
  static void remove_needless(std::vector<LeastLine>& minima) {
    std::vector<LeastLine> kept;
    for (std::size_t i = 0; i < minima.size(); ++i) {
      const std::vector<std::size_t>& lines = minima[i].lines;
      bool needed = true;
      for (std::size_t j = 0; j < minima.size(); ++j) {
        const std::vector<std::size_t>& fewer = minima[j].lines;
        const bool is_first = fewer.size() < lines.size() || (fewer == lines && j < i);
        needed =
            needed && !(is_first && std::includes(lines.begin(), lines.end(), fewer.begin(), fewer.end()));
      }
      if (needed) kept.push_back(minima[i]);
    }
    minima = std::move(kept);
  }

  const PiecewiseLinear& f_;
  std::vector<Pieces> below_;  ///< by line
};

}  // namespace

PiecewiseLinear through_points(std::span<const Rational> x, std::span<const Rational> value) {
  REQUIRES(x.size() >= 2 && x.size() == value.size());
  REQUIRES(std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) == x.end());
  PiecewiseLinear f;
  f.ends.push_back(x[0]);
  for (std::size_t i = 1; i < x.size(); ++i) {
    const Rational slope = (value[i] - value[i - 1]) / (x[i] - x[i - 1]);
    const Line line{slope, value[i] - slope * x[i]};
    if (!f.lines.empty() && f.lines.back() == line) {
      f.ends.back() = x[i];
    } else {
      f.lines.push_back(line);
      f.ends.push_back(x[i]);
    }
  }
  return f;
}

std::vector<LeastLine> as_maximum_of_minima(const PiecewiseLinear& f) {
  return Lattice(f).find();
}

}  // namespace coordreq
