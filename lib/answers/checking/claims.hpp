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

/// The values of one field of a results file; only the members of its kind are filled. Values over cells are
/// [entry of the leading axis][cell, row-major], with one entry if there is no leading axis.
struct FieldClaims {
  /// Steps and choices. kUnbounded: the largest number of the type, where it means unbounded.
  std::vector<std::vector<std::int32_t>> values;
  std::vector<std::vector<std::uint8_t>> members;  ///< of sets: 0 or 1
  std::vector<std::vector<float>> reals;           ///< of shares and probabilities
  std::vector<std::uint8_t> bits;                  ///< of actions: bytes [cells, ceil(m / 8)]
  std::vector<std::int64_t> integers;              ///< of a small field of integers
  std::vector<double> numbers;                     ///< of a small field of floating point numbers
  std::vector<std::uint64_t> cells;                ///< the attribute `cells`; empty if there is none
  // Other attributes that the analysis has found:
  std::map<std::string, std::int64_t> whole_attributes;
  std::map<std::string, double> real_attributes;
};

/// The claims of a results file, all of them to be checked: its fields by path, and the abstraction. Checks
/// read small fields of it as they would read them from a file.
class Claims : public FieldSource {
 public:
  std::map<std::string, FieldClaims> fields;  ///< all fields of the file, scales included
  std::optional<PackedPairs> listed;   ///< the pairs that `controller.file` lists, which are not checked
  std::vector<PostTable> abstraction;  ///< one a state, or empty
  bool same_version = true;            ///< written by this version of the program
  std::string file;                    ///< its path, for errors

  // @pre unchecked: for the functions below, the file has a field of that path and kind.
  [[nodiscard]] const FieldClaims& at(const std::string& path) const { return fields.at(path); }
  [[nodiscard]] const std::vector<std::int32_t>& values(const std::string& path,
                                                        std::size_t entry = 0) const {
    return at(path).values.at(entry);
  }
  [[nodiscard]] const std::vector<std::uint8_t>& members(const std::string& path,
                                                         std::size_t entry = 0) const {
    return at(path).members.at(entry);
  }
  /// Null: the bits are not stored.
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
