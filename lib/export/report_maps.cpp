#include "export/report_maps.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <set>
#include <span>

#include "answers/step_codes.hpp"
#include "export/base64.hpp"

namespace coordreq {
namespace {

constexpr int kLevel = 9;
constexpr std::int32_t kLowestFlag = -3;

/// The values of one set of cells, gathered from the blocks that they lie in.
class Gathering {
 public:
  explicit Gathering(const ReportCells& cells)
      : cells_(cells), values_(static_cast<std::size_t>(cells.count())) {}

  void add(const CellBlock& block, const std::vector<std::int32_t>& values) { visit(block, values, 0, 0, 0); }
  [[nodiscard]] const std::vector<std::int32_t>& values() const { return values_; }

 private:
  /// @param source,target number of the row-major prefix of the indices before dimension i
  void visit(const CellBlock& block, const std::vector<std::int32_t>& values, std::size_t i,
             std::int64_t source, std::int64_t target) {
    const std::vector<std::int64_t>& indices = cells_.indices[i];
    const std::int64_t first = block.first[i], count = block.count[i];
    source *= count;
    target *= static_cast<std::int64_t>(indices.size());
    const auto begin = std::lower_bound(indices.begin(), indices.end(), first);
    for (auto k = begin; k != indices.end() && *k < first + count; ++k) {
      const std::int64_t from = source + *k - first, to = target + (k - indices.begin());
      if (i + 1 < cells_.indices.size()) {
        visit(block, values, i + 1, from, to);
      } else {
        values_[static_cast<std::size_t>(to)] = values[static_cast<std::size_t>(from)];
      }
    }
  }

  const ReportCells& cells_;
  std::vector<std::int32_t> values_;
};

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

std::vector<std::byte> deflated(std::span<const std::byte> raw) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> packed(libdeflate_zlib_compress_bound(compressor.get(), raw.size()));
  packed.resize(
      libdeflate_zlib_compress(compressor.get(), raw.data(), raw.size(), packed.data(), packed.size()));
  return packed;
}

/// Little-endian.
template <class Code>
std::vector<std::byte> codes(const std::vector<std::int32_t>& values) {
  std::vector<std::byte> bytes;
  bytes.reserve(values.size() * sizeof(Code));
  for (const std::int32_t value : values) {
    const auto code =
        value == kUnbounded ? std::numeric_limits<Code>::max() : static_cast<Code>(value - kLowestFlag);
    for (std::size_t i = 0; i < sizeof(Code); ++i)
      bytes.push_back(static_cast<std::byte>(static_cast<std::uint32_t>(code) >> 8 * i & 0xffU));
  }
  return bytes;
}

PackedMap packed(const std::vector<std::int32_t>& values, std::int32_t largest) {
  const std::int64_t most = std::int64_t{largest} - kLowestFlag;
  if (most < std::numeric_limits<std::uint8_t>::max())
    return {1, base64(deflated(codes<std::uint8_t>(values)))};
  if (most < std::numeric_limits<std::uint16_t>::max())
    return {2, base64(deflated(codes<std::uint16_t>(values)))};
  return {4, base64(deflated(codes<std::uint32_t>(values)))};
}

}  // namespace

PackedMaps pack_map(const UniformGrid& grid, const ReadCells& read, const std::vector<ReportCells>& sets) {
  std::vector<Gathering> gatherings;
  for (const ReportCells& cells : sets) gatherings.emplace_back(cells);
  PackedMaps maps;
  std::set<std::int32_t> flags;
  for_each_block(grid, read, [&](const CellBlock& block, const std::vector<std::int32_t>& values) {
    for (Gathering& gathering : gatherings) gathering.add(block, values);
    for (const std::int32_t value : values) {
      if (value < 0 || value == kUnbounded) {
        flags.insert(value);
      } else {
        maps.largest = std::max(maps.largest, value);
      }
    }
  });
  for (const Gathering& gathering : gatherings) maps.sets.push_back(packed(gathering.values(), maps.largest));
  maps.flags.assign(flags.begin(), flags.end());
  return maps;
}

}  // namespace coordreq
