#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "answers/field_source.hpp"
#include "engine/packed_pairs.hpp"

namespace coordreq {

/// Infinite delays, triggers and collision times, whatever type they are stored as.
inline constexpr std::int32_t kForever = INT32_MAX;
/// What a delay says of cells that have none.
inline constexpr std::int32_t kOutsideSafe = -2;
inline constexpr std::int32_t kOutsideInvariant = -1;
/// And an approach delay of cells in K from where the goal cannot be forced.
inline constexpr std::int32_t kNoWayToGoal = -4;

/// What a results file says in one field: what its kind has, all else is empty. Of fields over cells
/// [entry of the leading axis][cell, row-major], with one entry where there is no such axis.
struct FieldClaims {
  /// Of steps and choices. kForever: the largest number of the type, where it has that meaning.
  std::vector<std::vector<std::int32_t>> values;
  std::vector<std::vector<std::uint8_t>> members;  ///< of sets: 0 or 1
  std::vector<std::vector<float>> reals;           ///< of shares and probabilities
  std::vector<std::uint8_t> bits;                  ///< of actions: bytes [cells, ceil(m / 8)]
  std::vector<std::int64_t> integers;              ///< of a small field
  std::vector<double> numbers;                     ///< likewise
  std::vector<std::uint64_t> cells;                ///< the attribute of this name; may be missing
  // Other attributes that the analysis has found:
  std::map<std::string, std::int64_t> whole_attributes;
  std::map<std::string, double> real_attributes;
};

/// What a results file says, all of it to be doubted: its fields by path, the abstraction apart. Checks read
/// small fields of it as they would of a file.
class Claims : public FieldSource {
 public:
  std::map<std::string, FieldClaims> fields;  ///< all that the file has, scales too
  std::optional<PackedPairs> listed;          ///< what `controller.file` lists, which is not doubted
  std::vector<PostTable> abstraction;         ///< one a state, or none
  bool same_version = true;                   ///< written by this version of the program
  std::string file;                           ///< its path, for errors

  // @pre unchecked: for what follows, the file has the field, of that kind.
  [[nodiscard]] const FieldClaims& at(const std::string& path) const { return fields.at(path); }
  [[nodiscard]] const std::vector<std::int32_t>& values(const std::string& path,
                                                        std::size_t entry = 0) const {
    return at(path).values.at(entry);
  }
  [[nodiscard]] const std::vector<std::uint8_t>& members(const std::string& path,
                                                         std::size_t entry = 0) const {
    return at(path).members.at(entry);
  }
  /// Null: they are not stored.
  [[nodiscard]] const std::vector<std::uint8_t>* bits(const std::string& path) const {
    const auto found = fields.find(path);
    return found == fields.end() ? nullptr : &found->second.bits;
  }

  [[nodiscard]] bool has(const std::string& path) const override { return fields.contains(path); }
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& path) const override;
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> list(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> counted(const std::string& path) const override;
  [[nodiscard]] std::int64_t attribute(const std::string& path, const std::string& name) const override;
  [[nodiscard]] double number(const std::string& path, const std::string& name) const override;
  void expect_length(const std::string& path, std::uint64_t length) const override;
  [[noreturn]] void fail(const std::string& what, const std::string& path) const override;
};

}  // namespace coordreq
