#include "answers/countdown/safe_sides.hpp"

#include <bit>
#include <numeric>
#include <vector>

#include "base/index.hpp"

namespace coordreq {
namespace {

/// A round that takes out less than this part of all that was taken out is the last.
constexpr std::int64_t kLeastFraction = 8;

/// Where the cells of a row go by the outward joint input: one cell of the post of each.
class OutwardCells {
 public:
  static constexpr std::int64_t kNone = -1;
  struct Target {
    std::int64_t row = kNone;
    std::int64_t offset = 0;  ///< along it
  };

  OutwardCells(const RowEngine& engine, const SafeSides& sides, std::int64_t u)
      : engine_(engine), sides_(sides) {
    const InputSpace& inputs = engine.abstraction().inputs;
    for (std::size_t i = 0; i < engine.tables(); ++i) {
      const RowSlices& slices = engine.slices()[i];
      inputs_.push_back(0);
      for (const std::int32_t j : slices.inputs)
        inputs_.back() += inputs.index(u, at(j)) * slices.input_stride[at(j)];
    }
  }

  /// Row kNone if the cells of the row do not all go on alike.
  [[nodiscard]] Target of(const RowPosition& position) const {
    Target target{.row = 0};
    for (std::size_t i = 0; i < engine_.tables(); ++i) {
      const RowSlices& slices = engine_.slices()[i];
      const std::vector<RowSegment>& segments =
          slices.slices[slices.number(slices.base(position) + inputs_[i])];
      const bool is_across = i < engine_.across();
      if (segments.size() != 1 ||
          segments.front().kind != (is_across ? RowSegment::Kind::fixed : RowSegment::Kind::shifted))
        return {};
      const IndexRange range = segments.front().range;
      const std::int64_t end = sides_.is_below(i) ? range.first : range.last;
      const GridDimension& dimension = engine_.grid()[i];
      if (is_across) {
        target.row += end % dimension.count * engine_.grid().row_stride(i);
      } else {
        target.offset = end;
      }
    }
    return target;
  }

 private:
  const RowEngine& engine_;
  const SafeSides& sides_;
  std::vector<std::int64_t> inputs_;  ///< [table] what the joint input adds to a position
};

/// Bits 64 w + offset, ..., 64 w + offset + 63 of a row of bits that is a function of its words.
template <class WordOf>
Word shifted_word(std::int64_t w, std::int64_t offset, std::int64_t words, const WordOf& word_of) {
  const std::int64_t begin = w * CellSet::kWordBits + offset;
  const std::int64_t first = begin >= 0 ? begin / CellSet::kWordBits : -((63 - begin) / CellSet::kWordBits);
  const std::int64_t shift = begin - first * CellSet::kWordBits;
  const auto word = [&](std::int64_t k) { return k >= 0 && k < words ? word_of(at(k)) : Word{0}; };
  return shift == 0 ? word(first) : word(first) >> shift | word(first + 1) << (CellSet::kWordBits - shift);
}

}  // namespace

std::int64_t take_out_runs(const AnalysisContext& context, const SafeSides& sides, const CellSet& all,
                           const CellSet& outward, ThreadTeam& team, CellSet& left) {
  const RowEngine& engine = *context.engine;
  if (!engine.posts().is_cut() || engine.along() != 1) return 0;
  const OutwardCells cells(engine, sides, sides.outward());
  const RowShare::Range local = local_rows(engine.share(), engine.rows());
  std::vector<OutwardCells::Target> targets(at(local.end - local.begin));
  std::int64_t total = 0;
  for (bool is_first = true, goes_on = true; goes_on; is_first = false) {
    const CellSet before = left;
    std::vector<std::int64_t> removed(at(std::int64_t{team.size()}), 0);
    for_each_local_row(team, engine.share(), engine.rows(), 64, [&](ThreadTeam::Range range, int worker) {
      RowPosition position(engine.grid(), range.begin);
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        OutwardCells::Target& target = targets[at(r - local.begin)];
        const MutableRow row = left.row(r);
        const ConstRow may = outward.row(r);
        if (is_first) {
          if (any_set(row)) target = cells.of(position);
          position.advance(engine.grid());
        }
        if (target.row == OutwardCells::kNone) continue;
        const ConstRow all_row = all.row(target.row), left_row = before.row(target.row);
        for (std::size_t w = 0; w < row.size(); ++w) {
          if ((row[w] & may[w]) == 0) continue;
          const Word out = shifted_word(static_cast<std::int64_t>(w), target.offset, std::ssize(row),
                                        [&](std::size_t k) { return all_row[k] & ~left_row[k]; });
          const Word leaving = out & row[w] & may[w];
          row[w] &= ~leaving;
          removed[at(worker)] += std::popcount(leaving);
        }
      }
    });
    const std::int64_t round = std::accumulate(removed.begin(), removed.end(), std::int64_t{0});
    total += round;
    goes_on = round > 0 && round >= total / kLeastFraction;
  }
  return total;
}

}  // namespace coordreq
