#include "engine/pair_table.hpp"

#include <algorithm>
#include <numeric>

#include "base/requires.hpp"

namespace coordreq {
namespace {

std::size_t words_for(const UniformGrid& grid) {
  return static_cast<std::size_t>((grid.row_length() + CellSet::kWordBits - 1) / CellSet::kWordBits);
}

/// The 8 x 8 bits of a word with rows (bytes) and columns exchanged; Warren, Hacker's Delight, 7-3.
Word transposed(Word bits) {
  Word swap = (bits ^ (bits >> 7U)) & 0x00AA00AA00AA00AAU;
  bits ^= swap ^ (swap << 7U);
  swap = (bits ^ (bits >> 14U)) & 0x0000CCCC0000CCCCU;
  bits ^= swap ^ (swap << 14U);
  swap = (bits ^ (bits >> 28U)) & 0x00000000F0F0F0F0U;
  return bits ^ swap ^ (swap << 28U);
}

/// Turns the sets of joint inputs of the cells of one row into a row of cells for each joint input.
/// @param out [joint input, up to a multiple of 8][word]
void turn_row(const std::uint8_t* cells, std::int64_t row_length, std::int64_t bytes, std::size_t words,
              std::vector<Word>& out) {
  out.assign(static_cast<std::size_t>(bytes) * 8 * words, 0);
  for (std::int64_t first = 0; first < row_length; first += 8) {
    const std::int64_t count = std::min<std::int64_t>(8, row_length - first);
    const auto word = static_cast<std::size_t>(first / CellSet::kWordBits);
    const auto shift = static_cast<unsigned>(first % CellSet::kWordBits);
    for (std::int64_t b = 0; b < bytes; ++b) {
      Word square = 0;
      for (std::int64_t x = 0; x < count; ++x) square |= Word{cells[(first + x) * bytes + b]} << (8 * x);
      if (square == 0) continue;
      square = transposed(square);
      for (std::size_t u = 0; u < 8; ++u) {
        out[(static_cast<std::size_t>(b) * 8 + u) * words + word] |= (square >> (8 * u) & 0xFFU) << shift;
      }
    }
  }
}

}  // namespace

PairTable::PairTable(const ConditionTable& allow) : positions_(allow.positions()) {
  for (std::int64_t r = 0; r < allow.table().rows(); ++r) ids_.push_back(rows_.number(allow.table().row(r)));
}

PairTable::PairTable(const UniformGrid& grid, const InputSpace& inputs, const PackedPairs& listed,
                     const PairTable* permitted, ThreadTeam::Range rows, ThreadTeam& team)
    : positions_{.grid = &grid,
                 .input_space = &inputs,
                 .inputs = std::vector<std::int32_t>(inputs.size()),
                 .state_stride = std::vector<std::int64_t>(grid.size(), 0)} {
  REQUIRES(listed.inputs == inputs.count());
  REQUIRES(std::ssize(listed.bytes) == grid.cells() * listed.bytes_per_cell());
  std::iota(positions_.inputs.begin(), positions_.inputs.end(), 0);
  for (std::size_t i = 0; i < inputs.size(); ++i) positions_.input_stride.push_back(inputs.stride(i));
  for (std::size_t i = 0; i + 1 < grid.size(); ++i)
    positions_.state_stride[i] = grid.stride(i) / grid.row_length() * inputs.count();
  positions_.before = rows.begin * inputs.count();
  ids_.reserve(static_cast<std::size_t>((rows.end - rows.begin) * inputs.count()));

  const std::size_t words = words_for(grid);
  const std::int64_t bytes = listed.bytes_per_cell();
  std::vector<std::vector<Word>> turned(64);  // rows are turned in batches, by all threads
  const auto batch = static_cast<std::int64_t>(turned.size());
  for (std::int64_t first = rows.begin; first < rows.end; first += batch) {
    const std::int64_t count = std::min(batch, rows.end - first);
    team.for_each(count, 4, [&](ThreadTeam::Range range, int) {
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        std::vector<Word>& bits = turned[static_cast<std::size_t>(r)];
        turn_row(listed.bytes.data() + (first + r) * grid.row_length() * bytes, grid.row_length(), bytes,
                 words, bits);
        for (std::int64_t u = 0; permitted != nullptr && u < inputs.count(); ++u) {
          const ConstRow cells = permitted->row(first + r, u);
          for (std::size_t w = 0; w < words; ++w) bits[static_cast<std::size_t>(u) * words + w] &= cells[w];
        }
      }
    });
    for (std::int64_t r = 0; r < count; ++r) {
      const Word* bits = turned[static_cast<std::size_t>(r)].data();
      for (std::int64_t u = 0; u < inputs.count(); ++u, bits += words)
        ids_.push_back(rows_.number({bits, words}));
    }
  }
}

}  // namespace coordreq
