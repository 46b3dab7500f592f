#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "results/hdf5_handle.hpp"
#include "results/stored_array.hpp"

namespace coordreq {

/// A results file opened for reading. Whatever it does not find as the contract says is a ResultsError that
/// names the file and the object in it; damage that HDF5 notices becomes an hdf5::Failure.
///
/// Nobody vouches for the file: links that lead elsewhere are not followed, and arrays are those of
/// StoredArray.
class ResultsFile {
 public:
  /// @param cache_bytes of unpacked chunks
  /// @throws IoError if the file is not there or cannot be read; ResultsError if it is not a results file of
  ///   a version that this program reads
  explicit ResultsFile(const std::string& path, std::size_t cache_bytes = std::size_t{32} << 20U);

  /// Attributes of the object at `path`; "/" for those of the file.
  [[nodiscard]] std::string text(const std::string& path, const std::string& attribute) const;
  /// @throws ResultsError also if it is not finite
  [[nodiscard]] double number(const std::string& path, const std::string& attribute) const;
  [[nodiscard]] std::int64_t integer(const std::string& path, const std::string& attribute) const;
  /// An integer that must not be negative.
  [[nodiscard]] std::uint64_t natural(const std::string& path, const std::string& attribute) const;
  /// A list of `count` integers that must not be negative. @pre count >= 1
  [[nodiscard]] std::vector<std::uint64_t> naturals(const std::string& path, const std::string& attribute,
                                                    std::uint64_t count) const;
  [[nodiscard]] bool has(const std::string& path, const std::string& attribute) const;

  [[nodiscard]] std::vector<std::uint64_t> shape(const std::string& dataset) const;
  /// @throws ResultsError if the dataset has another shape than `expected`
  void expect_shape(const std::string& dataset, const std::vector<std::uint64_t>& expected) const;
  /// @throws ResultsError if it has another shape, none of the types, or not all of its elements. No types:
  ///   strings
  void expect_array(const std::string& dataset, const std::vector<ElementType>& types,
                    const std::vector<std::uint64_t>& shape) const;
  /// @throws ResultsError if it is none of ours
  [[nodiscard]] ElementType element_type(const std::string& dataset) const;

  /// All elements of a short array. @pre unchecked: expect_array() has passed.
  [[nodiscard]] std::vector<double> numbers(const std::string& dataset) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& dataset) const;
  [[nodiscard]] std::vector<std::uint64_t> naturals(const std::string& dataset) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& dataset) const;
  /// A segment of a list of floating point numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string& dataset, std::uint64_t begin,
                                            std::uint64_t count) const;

  /// The elements offset[i], ..., offset[i] + count[i] - 1 of every dimension, row-major, into `out`; only
  /// the chunks that hold them are read. @throws ResultsError if they are stored as another type than `type`,
  /// or damaged. @pre they lie inside the shape. @pre unchecked: expect_array() has passed, `out` has room
  /// for them
  void read_block(const std::string& dataset, ElementType type, const std::vector<std::uint64_t>& offset,
                  const std::vector<std::uint64_t>& count, void* out) const;
  /// Whether there is an object at `path`. @throws ResultsError where a link does not lead to an object of
  /// the file itself
  [[nodiscard]] bool exists(const std::string& path) const;

  /// Paths of the dimension scales of a dataset, one an axis.
  [[nodiscard]] std::vector<std::string> axis_paths(const std::string& dataset) const;
  /// Names of the dimension scales of a dataset, without their groups.
  [[nodiscard]] std::vector<std::string> axes(const std::string& dataset) const;
  /// Names of what the group holds, in the order in which it was written.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;
  /// Paths of all datasets but those that only give an axis its length; sorted.
  [[nodiscard]] std::vector<std::string> datasets() const;

  /// Any object of the file. @throws ResultsError
  [[nodiscard]] hdf5::Handle open(const std::string& path) const;

  /// Where an error is: the file and an object in it.
  [[nodiscard]] std::string location(const std::string& object) const;

 private:
  [[nodiscard]] hdf5::Handle open_attribute(const std::string& path, const std::string& attribute) const;
  void check_format() const;
  void read_attribute(const std::string& path, const std::string& attribute, hid_t type,
                      std::initializer_list<H5T_class_t> classes, std::uint64_t count, void* out) const;
  template <typename Value>
  [[nodiscard]] std::vector<Value> elements(const std::string& dataset) const;
  void collect_datasets(const std::string& group, int depth, std::vector<std::string>& found) const;
  /// It stays open: asking what it is takes longer than reading a cell.
  [[nodiscard]] const StoredArray& array(const std::string& path) const;

  std::string path_;
  std::uint64_t bytes_ = 0;  // its length
  hdf5::Handle file_;
  mutable ChunkCache cache_;
  mutable std::map<std::string, StoredArray> arrays_;  // by path; closed before the file
};

}  // namespace coordreq
