#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "answers/field.hpp"

namespace coordreq {

/// How a row-major array is cut into the chunks of an HDF5 dataset.
///
/// 1. A chunk has length 1 in the leading dimensions, some length in one, and the full length in those after
///    it, so that its elements are one segment of the array.
/// 2. Chunks have about 1 MiB and never more: a larger one would not fit HDF5's default chunk cache, and
///    every read of a subset would unpack it anew. Smaller arrays are cut finer, so that there is work for
///    many threads.
/// 3. It depends on shape and element size alone, so that files do not depend on the number of threads.
/// Arrays of a few KiB are not chunked at all.
class ChunkLayout {
 public:
  ChunkLayout(std::vector<std::uint64_t> shape, std::size_t element_size);

  /// Bytes of a chunk of an array of so many bytes, at the most; 0 if that is not chunked.
  [[nodiscard]] static double largest_chunk(double bytes);

  [[nodiscard]] const std::vector<std::uint64_t>& shape() const { return shape_; }
  /// Product of the shape; 1 for a scalar.
  [[nodiscard]] std::uint64_t elements() const { return elements_; }

  [[nodiscard]] bool chunked() const { return !chunk_shape_.empty(); }
  /// Empty if not chunked.
  [[nodiscard]] const std::vector<std::uint64_t>& chunk_shape() const { return chunk_shape_; }
  /// Elements of a whole chunk, the padding of one at the edge included. @pre chunked()
  [[nodiscard]] std::uint64_t chunk_elements() const;
  [[nodiscard]] std::uint64_t chunk_count() const;

  /// The segment of the array that lies in one chunk.
  struct Segment {
    std::vector<std::uint64_t> offset;  ///< of the chunk's first element, by dimension
    std::uint64_t begin = 0;            ///< linear index of that element
    std::uint64_t count = 0;            ///< elements, without padding
  };
  /// Ascending in `begin`. @pre number < chunk_count()
  [[nodiscard]] Segment segment(std::uint64_t number) const;

 private:
  std::vector<std::uint64_t> shape_;
  std::uint64_t elements_ = 1;
  std::vector<std::uint64_t> chunk_shape_;
  std::size_t cut_ = 0;         // the dimension that is cut into segments
  std::uint64_t inner_ = 1;     // product of the dimensions after it
  std::uint64_t segments_ = 1;  // along it
};

}  // namespace coordreq
