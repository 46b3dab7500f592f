#include "results/stored_array.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "results/chunk_codec.hpp"

namespace coordreq {
namespace {

using Shape = std::vector<std::uint64_t>;

/// The product, or the largest number if it is larger than that.
std::uint64_t product(const Shape& shape, std::uint64_t first = 1) {
  std::uint64_t result = first;
  for (const std::uint64_t length : shape) {
    if (__builtin_mul_overflow(result, length, &result)) return UINT64_MAX;
  }
  return result;
}

[[maybe_unused]] bool is_inside(const Shape& offset, const Shape& count, const Shape& shape) {
  if (offset.size() != shape.size() || count.size() != shape.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (offset[i] > shape[i] || count[i] > shape[i] - offset[i]) return false;
  }
  return true;
}

std::vector<hsize_t> sizes(const Shape& shape) {
  return {shape.begin(), shape.end()};
}

/// Calls `visit(tuple)` for first <= tuple <= last, the last dimension fastest.
template <class Visit>
void for_each_tuple(const Shape& first, const Shape& last, const Visit& visit) {
  Shape tuple = first;
  for (;;) {
    visit(tuple);
    std::size_t i = tuple.size();
    while (i > 0 && tuple[i - 1] == last[i - 1]) {
      tuple[i - 1] = first[i - 1];
      --i;
    }
    if (i == 0) return;
    ++tuple[i - 1];
  }
}

/// Copies the elements that a chunk and a block have in common.
class Overlap {
 public:
  Overlap(const Shape& chunk_begin, const Shape& chunk, const Shape& block_begin, const Shape& block)
      : chunk_begin_(chunk_begin), chunk_(chunk), block_begin_(block_begin), block_(block) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      first_.push_back(std::max(chunk_begin[i], block_begin[i]));
      last_.push_back(std::min(chunk_begin[i] + chunk[i], block_begin[i] + block[i]) - 1);
    }
  }

  void copy(const std::byte* from, std::byte* to, std::size_t element) const {
    const std::size_t run = static_cast<std::size_t>(last_.back() - first_.back() + 1) * element;
    Shape last = last_;
    last.back() = first_.back();
    for_each_tuple(first_, last, [&](const Shape& at) {
      std::memcpy(to + linear_index(at, block_begin_, block_) * element,
                  from + linear_index(at, chunk_begin_, chunk_) * element, run);
    });
  }

 private:
  static std::uint64_t linear_index(const Shape& at, const Shape& begin, const Shape& lengths) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < at.size(); ++i) result = result * lengths[i] + (at[i] - begin[i]);
    return result;
  }

  const Shape& chunk_begin_;
  const Shape& chunk_;
  const Shape& block_begin_;
  const Shape& block_;
  Shape first_;
  Shape last_;
};

}  // namespace

const ChunkCache::Bytes* ChunkCache::find(const Key& key) {
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  found->second.used = ++clock_;
  return &found->second.bytes;
}

const ChunkCache::Bytes& ChunkCache::keep(const Key& key, Bytes bytes) {
  while (!entries_.empty() && bytes_ + bytes.size() > most_bytes_) {
    const auto oldest = std::min_element(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
      return a.second.used < b.second.used;
    });
    bytes_ -= oldest->second.bytes.size();
    entries_.erase(oldest);
  }
  bytes_ += bytes.size();
  return entries_.insert_or_assign(key, Entry{std::move(bytes), ++clock_}).first->second.bytes;
}

StoredArray::StoredArray(hdf5::Handle dataset, std::uint64_t file_bytes, std::string location)
    : dataset_(std::move(dataset)), file_bytes_(file_bytes), location_(std::move(location)) {
  read_layout();
  read_type();
}

void StoredArray::fail(const std::string& what) const {
  throw ResultsError(what, location_);
}

void StoredArray::read_type() {
  const hdf5::Handle stored(H5Dget_type(dataset_.get()), H5Tclose, "read a type");
  // Strings lie elsewhere; the array has the length and the location of each, whatever it is.
  constexpr std::uint64_t kStringBytes = 16;
  element_bytes_ = hdf5::holds_long_strings(stored) ? kStringBytes : H5Tget_size(stored.get());
  for (const ElementType type :
       {ElementType::uint8, ElementType::int16, ElementType::int32, ElementType::uint32, ElementType::int64,
        ElementType::uint64, ElementType::float32, ElementType::float64}) {
    if (H5Tequal(stored.get(), hdf5::number_type(type)) <= 0) continue;
    type_ = type;
    return;
  }
}

/// The properties come first: asking a virtual dataset for its shape would open other files.
void StoredArray::read_layout() {
  const hdf5::Handle properties(H5Dget_create_plist(dataset_.get()), H5Pclose, "read a layout");
  const H5D_layout_t layout = H5Pget_layout(properties.get());
  if (layout != H5D_CONTIGUOUS && layout != H5D_COMPACT && layout != H5D_CHUNKED)
    fail("a virtual dataset, which results do not have");
  if (H5Pget_external_count(properties.get()) != 0)
    fail("its elements are in another file, which results do not have");
  const hdf5::Handle space(H5Dget_space(dataset_.get()), H5Sclose, "read a shape");
  const std::vector<hsize_t> shape = hdf5::shape_of(space);
  shape_.assign(shape.begin(), shape.end());
  elements_ = product(shape_);
  read_filters(properties);
  if (layout != H5D_CHUNKED) return;
  std::vector<hsize_t> chunk(shape_.size());
  hdf5::check(H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), "read a layout");
  chunk_.assign(chunk.begin(), chunk.end());
}

void StoredArray::read_filters(const hdf5::Handle& properties) {
  const int filters = H5Pget_nfilters(properties.get());
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties.get(), static_cast<unsigned>(i), &flags, &values,
                                               nullptr, 0, nullptr, &config);
    int& filter_position = filter == H5Z_FILTER_SHUFFLE ? shuffle_ : deflate_;
    if ((filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE) || filter_position >= 0 ||
        (filter == H5Z_FILTER_SHUFFLE && deflate_ >= 0)) {
      fail("packed in a way that results are not: expected the filters shuffle and deflate");
    }
    filter_position = i;
  }
}

std::uint64_t StoredArray::chunk_count() const {
  std::uint64_t count = 1;
  for (std::size_t i = 0; i < shape_.size(); ++i) count *= (shape_[i] + chunk_[i] - 1) / chunk_[i];
  return count;
}

void StoredArray::check_storage() const {
  const std::uint64_t bytes = product(shape_, element_bytes_);
  if (chunk_.empty()) {
    // Compact ones have no location; the library has read them with the header.
    const haddr_t begin = H5Dget_offset(dataset_.get());
    const bool is_here = H5Dget_storage_size(dataset_.get()) == bytes &&
                         (begin == HADDR_UNDEF || (begin <= file_bytes_ && bytes <= file_bytes_ - begin));
    if (!is_here) fail("damaged: the file does not hold all of its elements");
    return;
  }
  if (elements_ == UINT64_MAX || product(chunk_, element_bytes_) > kMostChunkBytes) {
    fail("stored in chunks of more than " + std::to_string(kMostChunkBytes >> 20U) + " MiB");
  }
  const hdf5::Handle space(H5Dget_space(dataset_.get()), H5Sclose, "read a shape");
  hsize_t chunks = 0;
  hdf5::check(H5Dget_num_chunks(dataset_.get(), space.get(), &chunks), "count the chunks");
  if (chunks != chunk_count()) fail("damaged: the file does not hold all of its elements");
}

ChunkCache::Bytes StoredArray::unpacked(const Shape& begin) const {
  const auto size = static_cast<std::size_t>(element_bytes_);
  const auto bytes = static_cast<std::size_t>(product(chunk_, size));
  const std::vector<hsize_t> offset = sizes(begin);
  hsize_t stored = 0;
  if (H5Dget_chunk_storage_size(dataset_.get(), offset.data(), &stored) < 0 || stored == 0 ||
      stored > bytes + bytes / 64 + 1024) {
    fail("cannot read the numbers: damaged");
  }
  ChunkCache::Bytes packed(stored);
  std::uint32_t skipped = 0;
  if (H5Dread_chunk(dataset_.get(), H5P_DEFAULT, offset.data(), &skipped, packed.data()) < 0)
    fail("cannot read the numbers: damaged");
  const auto is_used = [skipped](int filter) { return filter >= 0 && (skipped >> filter & 1U) == 0; };
  const bool shuffled = is_used(shuffle_) && size > 1;
  ChunkCache::Bytes result;
  const bool done = unpack_chunk(packed, bytes, is_used(deflate_), shuffled ? size : 1, result);
  if (!done) fail("cannot read the numbers: damaged");
  return result;
}

const ChunkCache::Bytes& StoredArray::chunk(const Shape& number, ChunkCache& cache) const {
  std::uint64_t linear = 0;
  Shape begin = number;
  for (std::size_t i = 0; i < number.size(); ++i) {
    linear = linear * ((shape_[i] + chunk_[i] - 1) / chunk_[i]) + number[i];
    begin[i] *= chunk_[i];
  }
  const ChunkCache::Key key{this, linear};
  const ChunkCache::Bytes* const known = cache.find(key);
  return known != nullptr ? *known : cache.keep(key, unpacked(begin));
}

void StoredArray::read_contiguous(const Shape& offset, const Shape& count, void* out) const {
  const hdf5::Handle stored(H5Dget_space(dataset_.get()), H5Sclose, "read a shape");
  const std::vector<hsize_t> start = sizes(offset), lengths = sizes(count);
  const hdf5::Handle wanted = hdf5::create_space(lengths);
  // A scalar has no hyperslabs.
  if (!start.empty()) {
    hdf5::check(
        H5Sselect_hyperslab(stored.get(), H5S_SELECT_SET, start.data(), nullptr, lengths.data(), nullptr),
        "select a part");
  }
  if (H5Dread(dataset_.get(), hdf5::number_type(*type_), wanted.get(), stored.get(), H5P_DEFAULT, out) < 0)
    fail("cannot read the numbers: damaged");
}

void StoredArray::read(const Shape& offset, const Shape& count, void* out, ChunkCache& cache) const {
  REQUIRES(type_ && is_inside(offset, count, shape_));
  if (product(count) == 0) return;
  if (chunk_.empty()) return read_contiguous(offset, count, out);
  Shape first, last;
  for (std::size_t i = 0; i < shape_.size(); ++i) {
    first.push_back(offset[i] / chunk_[i]);
    last.push_back((offset[i] + count[i] - 1) / chunk_[i]);
  }
  for_each_tuple(first, last, [&](const Shape& number) {
    const ChunkCache::Bytes& bytes = chunk(number, cache);
    Shape begin = number;
    for (std::size_t i = 0; i < begin.size(); ++i) begin[i] *= chunk_[i];
    Overlap(begin, chunk_, offset, count).copy(bytes.data(), static_cast<std::byte*>(out), element_bytes_);
  });
}

}  // namespace coordreq
