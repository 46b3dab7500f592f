#include "results/array_writer.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// @param ranks who knows the array, or null
void write_whole(const hdf5::Handle& dataset, const std::string& path, std::uint64_t elements,
                 const ResultArray& array, RankChunks* ranks) {
  if (elements == 0) return;
  std::vector<std::byte> data;
  if (ranks != nullptr) {
    data = ranks->take(0);
  } else {
    data.resize(elements * element_size(array.type));
    array.fill(0, elements, data.data());
  }
  hdf5::check(
      H5Dwrite(dataset.get(), hdf5::number_type(array.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()),
      "write the dataset " + path);
}

/// Chunks are filled in pieces of so many bytes at most.
constexpr std::size_t kPieceBytes = std::size_t{32} << 10U;

hdf5::Storage storage_of(const ChunkLayout& layout, ElementType type) {
  hdf5::Storage storage;
  storage.chunk.assign(layout.chunk_shape().begin(), layout.chunk_shape().end());
  storage.deflate_level = kDeflateLevel;
  storage.shuffle = element_size(type) > 1;
  return storage;
}

}  // namespace

double ArrayWriter::bytes(double longest, int threads) {
  constexpr double kUsualPacking = 0.25;
  constexpr double kCopies = 1.5;  // of a chunk: shuffled, and packed
  constexpr double kPieces = 2;    // filled, and what filling takes
  const double chunk = ChunkLayout::largest_chunk(longest);
  if (chunk == 0) return 0;
  const double chunks = std::ceil(longest / chunk);
  const double batch = std::min(chunks, static_cast<double>(kChunksPerThread) * threads);
  // If an array has few chunks, those of the next array go to other threads.
  const double busy = std::min<double>(packers(threads), 4 * chunks);
  const double known = std::min(chunks, static_cast<double>(KnownChunks::most(packers(threads))));
  return busy * (kCopies * chunk + kPieces * kPieceBytes + ChunkCodec::kBytes) +
         (known + kUsualPacking * batch) * chunk;
}

ArrayWriter::ArrayWriter(ThreadTeam& team, const hdf5::OutputDriver& driver, RankChunks* ranks)
    : team_(team),
      driver_(driver),
      ranks_(ranks),
      packed_(static_cast<std::size_t>(team.size()) * kChunksPerThread) {
  for (ChunkCodec& codec : ChunkCodec::make(packers(team.size())))
    scratch_.push_back({.codec = std::move(codec), .raw = {}});
}

hdf5::Handle ArrayWriter::write(const hdf5::Handle& file, const std::string& path,
                                const std::vector<hsize_t>& shape, const ResultArray& array) {
  const ChunkLayout layout({shape.begin(), shape.end()}, element_size(array.type));
  hdf5::Handle dataset = hdf5::create_dataset(file, path, hdf5::number_type(array.type),
                                              hdf5::create_space(shape), storage_of(layout, array.type));
  RankChunks* const ranks = array.is_divided() ? ranks_ : nullptr;
  if (ranks != nullptr) ranks->pack(layout, array);
  if (layout.chunked()) {
    write_chunks(dataset, path, layout, array);
  } else {
    write_whole(dataset, path, layout.elements(), array, ranks);
  }
  driver_.check_written("write the dataset " + path);
  return dataset;
}

hdf5::Handle ArrayWriter::write_copy(const hdf5::Handle& file, const std::string& path,
                                     const std::vector<hsize_t>& shape, const ResultArray& array,
                                     const hdf5::Handle& original) {
  const ChunkLayout layout({shape.begin(), shape.end()}, element_size(array.type));
  if (!layout.chunked()) return write(file, path, shape, array);
  const std::string what = "write the dataset " + path;
  hdf5::Handle dataset = hdf5::create_dataset(file, path, hdf5::number_type(array.type),
                                              hdf5::create_space(shape), storage_of(layout, array.type));
  std::vector<std::byte>& packed = packed_.front();
  for (std::uint64_t i = 0; i < layout.chunk_count(); ++i) {
    const auto offset = layout.segment(i).offset;
    const std::vector<hsize_t> offset_of_chunk(offset.begin(), offset.end());
    hsize_t size = 0;
    hdf5::check(H5Dget_chunk_storage_size(original.get(), offset_of_chunk.data(), &size), what);
    packed.resize(size);
    std::uint32_t filters = 0;
    hdf5::check(H5Dread_chunk(original.get(), H5P_DEFAULT, offset_of_chunk.data(), &filters, packed.data()),
                what);
    hdf5::check(
        H5Dwrite_chunk(dataset.get(), H5P_DEFAULT, filters, offset_of_chunk.data(), size, packed.data()),
        what);
  }
  driver_.check_written(what);
  return dataset;
}

void ArrayWriter::write_chunks(const hdf5::Handle& dataset, const std::string& path,
                               const ChunkLayout& layout, const ResultArray& array) {
  const std::uint64_t chunks = layout.chunk_count();
  for (std::uint64_t first = 0; first < chunks; first += packed_.size()) {
    const std::size_t count = std::min<std::uint64_t>(packed_.size(), chunks - first);
    if (ranks_ != nullptr && array.is_divided()) {
      for (std::size_t i = 0; i < count; ++i) packed_[i] = ranks_->take(first + i);
    } else {
      pack_batch(layout, array, first, count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto offset = layout.segment(first + i).offset;
      const std::vector<hsize_t> offset_of_chunk(offset.begin(), offset.end());
      hdf5::check(H5Dwrite_chunk(dataset.get(), H5P_DEFAULT, 0, offset_of_chunk.data(), packed_[i].size(),
                                 packed_[i].data()),
                  "write the dataset " + path);
    }
    driver_.check_written("write the dataset " + path);
  }
}

void ArrayWriter::pack_batch(const ChunkLayout& layout, const ResultArray& array, std::uint64_t first,
                             std::size_t count) {
  const std::size_t size = element_size(array.type);
  // Each packer takes the next chunk until there is none.
  std::atomic<std::size_t> next = 0;
  team_.for_each(std::ssize(scratch_), 1, [&](ThreadTeam::Range range, int) {
    Scratch& scratch = scratch_[static_cast<std::size_t>(range.begin)];
    for (std::size_t i = next++; i < count; i = next++) {
      const ChunkLayout::Segment segment = layout.segment(first + i);
      scratch.codec.begin(layout.chunk_elements() * size, size);
      for (std::uint64_t done = 0; done < segment.count;) {
        const std::uint64_t piece = std::min<std::uint64_t>(kPieceBytes / size, segment.count - done);
        scratch.raw.resize(piece * size);
        array.fill(segment.begin + done, piece, scratch.raw.data());
        scratch.codec.put(scratch.raw);
        done += piece;
      }
      scratch.codec.finish(packed_[i]);
    }
  });
}

}  // namespace coordreq
