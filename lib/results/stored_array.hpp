#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/field.hpp"
#include "results/hdf5_handle.hpp"

namespace coordreq {

/// Unpacked chunks of all arrays of a file, the ones that were used last: single cells are read in any
/// order.
class ChunkCache {
 public:
  using Bytes = std::vector<std::byte>;
  /// The array and the number of its chunk.
  using Key = std::pair<const void*, std::uint64_t>;

  explicit ChunkCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The bytes of a chunk; null if they are not kept. Valid until the next keep().
  [[nodiscard]] const Bytes* find(const Key& key);
  const Bytes& keep(const Key& key, Bytes bytes);

 private:
  struct Entry {
    Bytes bytes;
    std::uint64_t used = 0;
  };
  std::map<Key, Entry> entries_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::uint64_t clock_ = 0;
};

/// A dataset in a file that is not trusted. What it says about itself is checked before
/// anything is read or made room for:
///
/// 1. Its elements lie in the file: no external files, no virtual datasets. So many bytes as the shape needs
///    are there: contiguous, or as chunks of at most kMostChunkBytes, every one of them.
/// 2. Filters are none, or those that we write: `shuffle`, `deflate`. They are undone here and not by the
///    library, which makes its buffers as large as what a chunk unpacks to.
class StoredArray {
 public:
  static constexpr std::uint64_t kMostChunkBytes = std::uint64_t{4} << 20U;

  /// @param file_bytes length of the file
  /// @throws hdf5::Failure; ResultsError naming `location` and what is wrong with it
  StoredArray(hdf5::Handle dataset, std::uint64_t file_bytes, std::string location);

  /// None if it is not one that we write: strings, and axes that have no coordinates.
  [[nodiscard]] std::optional<ElementType> type() const { return type_; }
  [[nodiscard]] bool is_contiguous() const { return chunk_.empty(); }
  [[nodiscard]] const hdf5::Handle& dataset() const { return dataset_; }
  [[nodiscard]] const std::vector<std::uint64_t>& shape() const { return shape_; }
  [[nodiscard]] std::uint64_t elements() const { return elements_; }

  /// Checks that the file has all elements of the array. @throws ResultsError if not
  void check_storage() const;

  /// The elements offset[i], ..., offset[i] + count[i] - 1 of every dimension, row-major, into `out`.
  /// @pre they lie inside shape(); there is a type(). @pre unchecked: `out` has room for them;
  /// check_storage() has passed
  void read(const std::vector<std::uint64_t>& offset, const std::vector<std::uint64_t>& count, void* out,
            ChunkCache& cache) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void read_type();
  void read_layout();
  void read_filters(const hdf5::Handle& properties);
  [[nodiscard]] std::uint64_t chunk_count() const;
  [[nodiscard]] const ChunkCache::Bytes& chunk(const std::vector<std::uint64_t>& number,
                                               ChunkCache& cache) const;
  [[nodiscard]] ChunkCache::Bytes unpacked(const std::vector<std::uint64_t>& begin) const;
  void read_contiguous(const std::vector<std::uint64_t>& offset, const std::vector<std::uint64_t>& count,
                       void* out) const;

  hdf5::Handle dataset_;
  std::uint64_t file_bytes_;
  std::string location_;
  std::optional<ElementType> type_;
  std::uint64_t element_bytes_ = 1;
  std::vector<std::uint64_t> shape_;
  std::uint64_t elements_ = 1;
  std::vector<std::uint64_t> chunk_;  // its shape; empty if contiguous
  int shuffle_ = -1;                  // position among the filters
  int deflate_ = -1;
};

}  // namespace coordreq
