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
  const int packing = packers(threads, static_cast<std::uint64_t>(chunks));
  const double busy = std::min<double>(packing, 4 * chunks);
  const double known = std::min(chunks, static_cast<double>(KnownChunks::most(packing)));
  return busy * (kCopies * chunk + kPieces * kPieceBytes + ChunkCodec::kBytes) +
         (known + kUsualPacking * batch) * chunk;
}

ArrayWriter::ArrayWriter(ThreadTeam& team, const hdf5::OutputDriver& driver, RankChunks* ranks)
    : team_(team),
      driver_(driver),
      ranks_(ranks),
      known_(std::make_shared<KnownChunks>(packers(team.size(), 0))),
      packed_(static_cast<std::size_t>(team.size()) * kChunksPerThread) {}

hdf5::Handle ArrayWriter::write(const hdf5::Handle& file, const std::string& path,
                                const std::vector<hsize_t>& shape, const ResultArray& array) {
  const ChunkLayout layout({shape.begin(), shape.end()}, element_size(array.type));
  hdf5::Handle dataset = hdf5::create_dataset(file, path, hdf5::number_type(array.type),
                                              hdf5::create_space(shape), storage_of(layout, array.type));
  RankChunks* const ranks = array.is_divided() ? ranks_ : nullptr;
  if (ranks != nullptr) ranks->pack(layout, array);
  if (layout.chunked()) {
    write_chunks({dataset, path, layout}, array);
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

void ArrayWriter::write_chunks(const Target& target, const ResultArray& array) {
  const std::uint64_t chunks = target.layout.chunk_count();
  const std::span<std::vector<std::byte>> all(packed_);
  const std::size_t most = all.size() / 2;
  Batch before;
  for (std::uint64_t first = 0; first < chunks; first += most) {
    const std::size_t half = first / most % 2 * most;
    const Batch batch{first, all.subspan(half, std::min<std::uint64_t>(most, chunks - first))};
    if (ranks_ != nullptr && array.is_divided()) {
      for (std::size_t i = 0; i < batch.packed.size(); ++i) batch.packed[i] = ranks_->take(first + i);
      write_batch(target, before);
    } else {
      pack_batch(target, array, batch, before);
    }
    before = batch;
  }
  write_batch(target, before);
}

void ArrayWriter::write_batch(const Target& target, const Batch& batch) const {
  const std::string what = "write the dataset " + target.path;
  for (std::size_t i = 0; i < batch.packed.size(); ++i) {
    const auto offset = target.layout.segment(batch.first + i).offset;
    const std::vector<hsize_t> offset_of_chunk(offset.begin(), offset.end());
    const std::vector<std::byte>& packed = batch.packed[i];
    hdf5::check(H5Dwrite_chunk(target.dataset.get(), H5P_DEFAULT, 0, offset_of_chunk.data(), packed.size(),
                               packed.data()),
                what);
  }
  driver_.check_written(what);
}

void ArrayWriter::pack_batch(const Target& target, const ResultArray& array, const Batch& batch,
                             const Batch& before) {
  const int packing = packers(team_.size(), target.layout.chunk_count());
  while (std::ssize(scratch_) < packing) scratch_.push_back({.codec = ChunkCodec(known_), .raw = {}});
  // Each packer takes the next chunk until there is none.
  std::atomic<std::size_t> next = 0;
  bool is_before_written = false;  // known to this thread alone, worker 0
  team_.for_each(packing, 1, [&](ThreadTeam::Range range, int worker) {
    if (worker == 0 && !std::exchange(is_before_written, true)) write_batch(target, before);
    Scratch& scratch = scratch_[static_cast<std::size_t>(range.begin)];
    for (std::size_t i = next++; i < batch.packed.size(); i = next++)
      pack_chunk(target.layout, array, batch.first + i, scratch, batch.packed[i]);
  });
  if (!is_before_written) write_batch(target, before);
}

void ArrayWriter::pack_chunk(const ChunkLayout& layout, const ResultArray& array, std::uint64_t chunk,
                             Scratch& scratch, std::vector<std::byte>& packed) const {
  const std::size_t size = element_size(array.type);
  const ChunkLayout::Segment segment = layout.segment(chunk);
  scratch.codec.begin(layout.chunk_elements() * size, size);
  for (std::uint64_t done = 0; done < segment.count;) {
    const std::uint64_t piece = std::min<std::uint64_t>(kPieceBytes / size, segment.count - done);
    scratch.raw.resize(piece * size);
    array.fill(segment.begin + done, piece, scratch.raw.data());
    scratch.codec.put(scratch.raw);
    done += piece;
  }
  scratch.codec.finish(packed);
}

}  // namespace coordreq
