#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/field_source.hpp"
#include "model/cell_block.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "reach/abstraction.hpp"
#include "results/results_parts.hpp"

namespace coordreq {

class ResultsFile;

/// A results file opened for reading, together with its spec.
///
/// 1. The constructor reads everything but the arrays over cells: in a child process first, because damaged
///    files can crash the HDF5 library (see try_in_child()). It checks that the file fits its spec: digest,
///    grid points, partitions, shapes and types. Values of attributes are only read; whether they are right
///    is for a verification.
/// 2. Arrays over cells are read on demand, for a block or a stretch of cells; only the chunks concerned are
///    unpacked. Numbers are checked to be ones that the contract knows.
///
/// Every member function throws ResultsError naming the file and the object where something is missing,
/// damaged or not as the contract says, IoError where the system cannot read. Not thread-safe, and no two
/// objects may be used at the same time from different threads: the HDF5 library admits one caller.
class ResultsReader : public FieldSource {
 public:
  /// Infinite delays, triggers and collision times, whatever type they are stored as.
  static constexpr std::int32_t kNever = INT32_MAX;

  /// @param max_memory bytes that reading may take; arrays are read in parts, of which a few are kept
  /// @throws IoError if the file is not there or cannot be read; ResultsError if it is no results file of a
  ///   version that this program reads, or is damaged, or its spec is none; LimitError
  explicit ResultsReader(const std::string& path, std::optional<std::uint64_t> max_memory = std::nullopt);
  ~ResultsReader() override;
  ResultsReader(const ResultsReader&) = delete;
  ResultsReader& operator=(const ResultsReader&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Bytes that reading may take, if that is limited.
  [[nodiscard]] std::optional<std::uint64_t> max_memory() const { return max_memory_; }
  /// The embedded spec, read by read_spec().
  [[nodiscard]] const ProblemSpec& spec() const { return parts_.spec; }
  [[nodiscard]] const UniformGrid& grid() const { return grid_; }
  [[nodiscard]] const InputSpace& inputs() const { return inputs_; }
  [[nodiscard]] const StoredAttributes& attributes() const { return parts_.attributes; }
  /// As many as the spec has, in its order.
  [[nodiscard]] const std::vector<StoredPartition>& partitions() const { return parts_.partitions; }

  /// As many as the spec has, in its order.
  [[nodiscard]] const std::vector<ResultRequirement>& requirements() const { return parts_.requirements; }

  /// What the file holds.
  [[nodiscard]] const Fields& fields() const { return parts_.fields; }
  [[nodiscard]] bool has(const std::string& path) const override { return field_of_path_.contains(path); }
  /// REQUIRES: the file has it.
  [[nodiscard]] const Field& field(const std::string& path) const;
  /// Entries along the axis before those of the cells; 0: there is none.
  [[nodiscard]] std::size_t leading_length(const Field& field) const;
  /// What each entry along that axis is called. REQUIRES: there is one.
  [[nodiscard]] const std::vector<std::string>& leading_names(const Field& field) const;
  /// The number of steps of a field over partitions that says `at least`, since `max_delay` ended the
  /// iteration; none if F is known. REQUIRES: partition < partitions().size().
  [[nodiscard]] std::optional<std::int64_t> lower_bound(const Field& field, std::size_t partition) const;
  /// Integers of a field over cells, kNever where the type's largest value means that there is no end.
  /// @param leading place along an axis before those of the cells, if there is one
  [[nodiscard]] std::vector<std::int32_t> values(const Field& field, std::optional<std::size_t> leading,
                                                 const CellBlock& block) const;
  /// The same of a field of 0 and 1.
  [[nodiscard]] std::vector<std::uint8_t> members(const Field& field, std::optional<std::size_t> leading,
                                                  const CellBlock& block) const;
  /// The same of a field of floating point.
  [[nodiscard]] std::vector<float> shares(const Field& field, std::optional<std::size_t> leading,
                                          const CellBlock& block) const;
  /// One bit an action: bytes [cells of the block, ceil(m / 8)] of a field over cells and bytes.
  [[nodiscard]] std::vector<std::uint8_t> packed(const Field& field, const CellBlock& block) const;
  /// Small fields, as a whole.
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& path) const override;
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> counted(const std::string& path) const override;
  [[nodiscard]] std::int64_t attribute(const std::string& path, const std::string& name) const override;
  [[noreturn]] void fail(const std::string& what, const std::string& path) const override;
  /// Paths of all datasets, sorted; without bare dimensions, which hold no data.
  [[nodiscard]] std::vector<std::string> datasets() const;

  /// Membership in S and K: 0 or 1.
  [[nodiscard]] std::vector<std::uint8_t> safe(const CellBlock& block) const;
  [[nodiscard]] std::vector<std::uint8_t> invariant(const CellBlock& block) const;
  /// Steps; 0 outside S, kNever inside K.
  [[nodiscard]] std::vector<std::int32_t> collision_time(const CellBlock& block) const;
  /// Steps; -2 outside S, -1 in S but not in K, kNever: unbounded. REQUIRES: partition < partitions().size().
  [[nodiscard]] std::vector<std::int32_t> delay(std::size_t partition, const CellBlock& block) const;
  /// Steps; -2 and -1 likewise, -3: a connection must stand already, kNever: never.
  [[nodiscard]] std::vector<std::int32_t> trigger(std::size_t partition, const CellBlock& block) const;

  /// Whether each of some modes is safe for each cell: 0 or 1, [modes, cells of the block].
  /// REQUIRES: the spec has a network with modes first, ..., first + modes - 1.
  [[nodiscard]] std::vector<std::uint8_t> network_safe(std::size_t first, std::size_t modes,
                                                       const CellBlock& block) const;
  /// Whether the spec has a horizon, so that there is a coalition map.
  [[nodiscard]] bool has_coalition() const { return parts_.spec.coordination.horizon.has_value(); }
  /// Index into partitions() of the cheapest one that suffices; -3: none does, -2: outside S, -1: in S but
  /// not in K. REQUIRES: has_coalition().
  [[nodiscard]] std::vector<std::int32_t> coalition(const CellBlock& block) const;
  /// Names of the pairs of agents, "a+b", in their order; none without a coalition map.
  [[nodiscard]] const std::vector<std::string>& pairs() const { return parts_.pairs; }
  /// 1 where the two are together in every partition of least cost that suffices, else 0.
  /// REQUIRES: pair < pairs().size().
  [[nodiscard]] std::vector<std::uint8_t> critical_pair(std::size_t pair, const CellBlock& block) const;

  /// What is stored on request.
  [[nodiscard]] bool has_actions(std::size_t partition) const;
  [[nodiscard]] bool has_controller() const;
  [[nodiscard]] bool has_layers(std::size_t partition) const;
  [[nodiscard]] bool has_abstraction() const;

  /// Admissible joint actions of a class: bytes [cells of the block, ceil(m / 8)], action a is bit a % 8 of
  /// byte a / 8. REQUIRES: has_actions(partition).
  [[nodiscard]] std::vector<std::uint8_t> action_bits(std::size_t partition, std::size_t class_number,
                                                      const CellBlock& block) const;
  /// The same for C(x) over the joint inputs. REQUIRES: has_controller().
  [[nodiscard]] std::vector<std::uint8_t> controller_bits(const CellBlock& block) const;
  /// The same for the pairs that `controller.file` lists. REQUIRES: the spec has one.
  [[nodiscard]] std::vector<std::uint8_t> listed_bits(const CellBlock& block) const;
  /// What agents may do by convention is stored.
  [[nodiscard]] bool has_convention() const;
  /// As action_bits(), of one agent. REQUIRES: has_convention().
  [[nodiscard]] std::vector<std::uint8_t> convention_bits(std::size_t agent, const CellBlock& block) const;
  /// REQUIRES: has_layers(partition). `start` is checked to ascend from 0 to the number of cells, `cell` to
  /// hold cells of the grid.
  [[nodiscard]] StoredLayers layers(std::size_t partition) const;
  /// The finite abstraction. `exact` is not stored and left true. REQUIRES: has_abstraction().
  [[nodiscard]] Abstraction abstraction() const;

  /// The cells begin, ..., end - 1 by linear index: `read(block)` for each of the blocks that they are,
  /// joined. Example: results.stretch(0, 1000, [&](const CellBlock& b) { return results.safe(b); })
  template <class Read>
  [[nodiscard]] auto stretch(std::int64_t begin, std::int64_t end, const Read& read) const {
    decltype(read(CellBlock())) all;
    for (const CellBlock& block : blocks_of_stretch(grid_, begin, end)) {
      const auto part = read(block);
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

 private:
  template <class Value>
  [[nodiscard]] std::vector<Value> elements(const std::string& dataset, ElementType type,
                                            const std::vector<std::uint64_t>& offset,
                                            const std::vector<std::uint64_t>& count) const;
  [[nodiscard]] std::vector<std::uint8_t> bits(const std::string& dataset, std::int64_t actions,
                                               const CellBlock& block) const;
  [[nodiscard]] std::vector<std::uint64_t> whole(const std::string& dataset) const;

  std::string path_;
  std::optional<std::uint64_t> max_memory_;
  std::unique_ptr<ResultsFile> file_;  // HDF5 stays inside this module
  ResultsParts parts_;
  std::map<std::string, std::size_t> field_of_path_;
  std::map<std::string, std::vector<std::int64_t>> fixed_points_;  ///< by Field::fixed_points
  UniformGrid grid_;
  InputSpace inputs_;
};

}  // namespace coordreq
