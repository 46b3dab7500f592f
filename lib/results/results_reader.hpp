#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "answers/field_source.hpp"
#include "answers/layers/stored_partition.hpp"
#include "base/requires.hpp"
#include "model/cell_block.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "reach/abstraction.hpp"
#include "results/results_metadata.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

class ResultsFile;
struct ResultsMetadata;

/// A results file opened for reading, together with its spec.
///
/// 1. The constructor reads everything but the arrays of cells: in a child process first, because damaged
///    files can crash the HDF5 library (see try_in_child()). It checks that the file fits its spec: digest,
///    grid points, partitions, shapes and types. Values of attributes are only read; whether they are right
///    is for a verification.
/// 2. Arrays of cells are read on demand, for a block or a run of cells; only the chunks concerned are
///    unpacked. Numbers are checked to be ones that the contract knows.
///
/// Every member function throws ResultsError naming the file and the object where something is missing,
/// damaged or not as the contract says, IoError where the system cannot read. Not thread-safe, and no two
/// objects may be used at the same time from different threads: the HDF5 library admits one caller.
class ResultsReader : public FieldSource {
 public:
  /// Infinite delays, triggers and collision times, whatever type they are stored as.

  /// @param max_memory bytes that reading may take; arrays are read in blocks, of which a few are kept
  /// @throws IoError if the file is not there or cannot be read; ResultsError if it is no results file of a
  ///   version that this program reads, or is damaged, or its spec is none; LimitError
  explicit ResultsReader(const std::string& path, std::optional<std::uint64_t> max_memory = std::nullopt);
  ~ResultsReader() override;
  ResultsReader(const ResultsReader&) = delete;
  ResultsReader& operator=(const ResultsReader&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Bytes that reading may take, if that is limited.
  [[nodiscard]] std::optional<std::uint64_t> max_memory() const { return max_memory_; }
  /// Memory of reading cells, at most kBlockCells at a time, with the chunks that are kept.
  [[nodiscard]] double reading_bytes() const;
  /// The embedded spec, read by read_spec().
  [[nodiscard]] const ProblemSpec& spec() const;
  [[nodiscard]] const UniformGrid& grid() const { return grid_; }
  [[nodiscard]] const InputSpace& inputs() const { return inputs_; }
  [[nodiscard]] const StoredAttributes& attributes() const;
  /// The partitions of the spec, in its order.
  [[nodiscard]] const std::vector<StoredPartition>& partitions() const;

  /// The fields that the file has.
  [[nodiscard]] const Fields& fields() const;
  [[nodiscard]] bool has(const std::string& path) const override { return field_of_path_.contains(path); }
  /// @pre the file has it
  [[nodiscard]] const Field& field(const std::string& path) const;
  [[nodiscard]] double elements(const Field& field) const;
  /// Entries along the axis before those of the cells; 0: there is none.
  [[nodiscard]] std::size_t leading_length(const Field& field) const;
  /// Names of the entries along the leading axis. @pre there is one
  [[nodiscard]] const std::vector<std::string>& leading_names(const Field& field) const;
  /// The number of steps of a field by partition that says `at least`, since `max_delay` ended the
  /// iteration; none if F is known. @pre partition < partitions().size()
  [[nodiscard]] std::optional<std::int64_t> lower_bound(const Field& field, std::size_t partition) const;
  /// Place along the axis before those of the cells; none where there is no such axis.
  using Leading = std::optional<std::size_t>;
  /// Integers of a field by cell, kUnbounded where the type's largest value means that there is no end; of
  /// probabilities the bits, see probability_of().
  [[nodiscard]] std::vector<std::int32_t> values(const Field& field, Leading leading,
                                                 const CellBlock& block) const;
  /// values() of a field that is a set: 0 or 1.
  [[nodiscard]] std::vector<std::uint8_t> members(const Field& field, Leading leading,
                                                  const CellBlock& block) const;
  /// values() of a field of shares or probabilities.
  [[nodiscard]] std::vector<float> reals(const Field& field, Leading leading, const CellBlock& block) const;
  /// The values of a field of m actions: bytes [cells of the block, ceil(m / 8)], action a is bit a % 8 of
  /// byte a / 8.
  [[nodiscard]] std::vector<std::uint8_t> bits(const Field& field, const CellBlock& block) const;
  /// The bytes along the last axis of a field of them, at the indices along all others.
  [[nodiscard]] std::vector<std::uint8_t> bytes(const Field& field,
                                                const std::vector<std::int64_t>& indices) const;
  /// All bytes of such a field, row-major.
  [[nodiscard]] std::vector<std::uint8_t> bytes(const Field& field) const;
  /// The length of an axis. @pre the file has it
  [[nodiscard]] std::uint64_t length(const std::string& scale) const;
  /// values() of the field at a path. @pre the file has it
  [[nodiscard]] std::vector<std::int32_t> values(const std::string& path, Leading leading,
                                                 const CellBlock& block) const {
    REQUIRES(has(path));
    return values(field(path), leading, block);
  }
  [[nodiscard]] std::vector<std::int32_t> values(const std::string& path, const CellBlock& block) const {
    return values(field(path), std::nullopt, block);
  }
  [[nodiscard]] std::vector<std::uint8_t> members(const std::string& path, const CellBlock& block) const {
    return members(field(path), std::nullopt, block);
  }
  [[nodiscard]] std::vector<std::uint8_t> bits(const std::string& path, const CellBlock& block) const {
    return bits(field(path), block);
  }
  /// Small fields, as a whole.
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& path) const override;
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> list(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> counted(const std::string& path) const override;
  [[nodiscard]] std::int64_t attribute(const std::string& path, const std::string& name) const override;
  [[nodiscard]] double number(const std::string& path, const std::string& name) const override;
  void expect_length(const std::string& path, std::uint64_t length) const override;
  [[noreturn]] void fail(const std::string& what, const std::string& path) const override;
  /// Paths of all datasets, sorted; without bare dimensions, which hold no data.
  [[nodiscard]] std::vector<std::string> datasets() const;

  [[nodiscard]] bool has_abstraction() const;
  /// The finite abstraction. `exact` is not stored and left true. @pre has_abstraction()
  [[nodiscard]] Abstraction abstraction() const;

  /// The cells begin, ..., end - 1 by linear index: `read(block)` for each of the blocks that they are,
  /// joined. Example: results.read_run(0, 1000, [&](const CellBlock& b) { return results.members("/safe", b);
  /// })
  template <class Read>
  [[nodiscard]] auto read_run(std::int64_t begin, std::int64_t end, const Read& read) const {
    decltype(read(CellBlock())) all;
    for (const CellBlock& block : blocks_of_run(grid_, begin, end)) {
      const auto block_values = read(block);
      all.insert(all.end(), block_values.begin(), block_values.end());
    }
    return all;
  }

 private:
  template <class Value>
  [[nodiscard]] std::vector<Value> elements(const std::string& dataset, ElementType type,
                                            const std::vector<std::uint64_t>& offset,
                                            const std::vector<std::uint64_t>& count) const;

  std::string path_;
  std::optional<std::uint64_t> max_memory_;
  std::size_t cache_bytes_;
  std::unique_ptr<ResultsFile> file_;  // HDF5 stays inside this module
  std::unique_ptr<const ResultsMetadata> metadata_;
  std::map<std::string, std::size_t> field_of_path_;
  std::map<std::string, std::vector<std::int64_t>> fixed_points_;  ///< by Field::fixed_points
  UniformGrid grid_;
  InputSpace inputs_;
};

/// A number for each cell: steps, or a position in a list; -3 to -1 are flags, kUnbounded is
/// infinity.
using ReadCells = std::function<std::vector<std::int32_t>(const CellBlock&)>;

/// Calls `visit(block, values)` for all cells in row-major order, about a million at a time.
template <class Visit>
void for_each_block(const UniformGrid& grid, const ReadCells& read, const Visit& visit) {
  for (std::int64_t begin = 0; begin < grid.cells(); begin += kBlockCells) {
    const std::int64_t end = std::min(begin + kBlockCells, grid.cells());
    for (const CellBlock& block : blocks_of_run(grid, begin, end)) visit(block, read(block));
  }
}

/// The first cell with the largest finite value of at least 0; if there is none the first with an infinite
/// one; else -1.
[[nodiscard]] std::int64_t first_largest(const UniformGrid& grid, const ReadCells& read);

}  // namespace coordreq
