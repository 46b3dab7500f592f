#include "results/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "results/appended_digest.hpp"
#include "results/child_trial.hpp"
#include "results/hdf5_handle.hpp"
#include "results/output_driver.hpp"

namespace coordreq {
namespace {

using hdf5::check;
using hdf5::Handle;

constexpr hsize_t kChunkBytes = hsize_t{1} << 20U;
/// Shorter lists stand with their description.
constexpr hsize_t kCompactBytes = 1024;
constexpr std::uint64_t kLongestText = 4096;
constexpr hsize_t kMostNumbers = hsize_t{1} << 48U;
constexpr unsigned kQuickDeflate = 1;  // it has to be done again in a minute
/// Deflate packs no more than so many bytes into one.
constexpr double kMostPacked = 1100;
constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";

hid_t type_of(NumberKind kind, std::int64_t bytes) {
  switch (kind) {
    case NumberKind::real:
      return bytes == 4 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
    case NumberKind::signed_integer:
      return bytes == 1   ? H5T_STD_I8LE
             : bytes == 2 ? H5T_STD_I16LE
             : bytes == 4 ? H5T_STD_I32LE
                          : H5T_STD_I64LE;
    case NumberKind::unsigned_integer:
      break;
  }
  return bytes == 1 ? H5T_STD_U8LE : bytes == 2 ? H5T_STD_U16LE : bytes == 4 ? H5T_STD_U32LE : H5T_STD_U64LE;
}

/// [rows, numbers of a row]
using Shape = std::array<hsize_t, 2>;

Shape shape_of(const NumberRows& rows) {
  return {static_cast<hsize_t>(rows.rows), static_cast<hsize_t>(rows.row_length)};
}

bool is_compact(const Shape& shape, hsize_t number_bytes) {
  return shape[0] * shape[1] * number_bytes <= kCompactBytes;
}

/// Whole rows, or a part of one.
Shape chunk_of(const Shape& shape, hsize_t number_bytes) {
  const hsize_t numbers = kChunkBytes / number_bytes;
  if (shape[1] >= numbers) return {1, numbers};
  return {std::min(shape[0], numbers / shape[1]), shape[1]};
}

Handle storage_of(const Shape& shape, hsize_t number_bytes) {
  Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create a property list");
  check(H5Pset_obj_track_times(list.get(), 0), "turn object times off");
  if (is_compact(shape, number_bytes)) {
    check(H5Pset_layout(list.get(), H5D_COMPACT), "choose a layout");
    return list;
  }
  check(H5Pset_chunk(list.get(), 2, chunk_of(shape, number_bytes).data()), "choose chunks");
  check(H5Pset_deflate(list.get(), kQuickDeflate), "choose a filter");
  check(H5Pset_fletcher32(list.get()), "choose a filter");
  return list;
}

Handle space_of(const Shape& shape) {
  return hdf5::create_space({shape.begin(), shape.end()});
}

/// Calls `visit` with the first row and number, and the size, of every part that a chunk holds.
template <class Visit>
void for_each_part(const Shape& shape, hsize_t number_bytes, const Visit& visit) {
  const Shape chunk = is_compact(shape, number_bytes) ? shape : chunk_of(shape, number_bytes);
  for (hsize_t row = 0; row < shape[0]; row += chunk[0]) {
    for (hsize_t column = 0; column < shape[1]; column += chunk[1])
      visit(Shape{row, column},
            Shape{std::min(chunk[0], shape[0] - row), std::min(chunk[1], shape[1] - column)});
  }
}

/// Calls `copy` with each piece of a row in memory, and its place in the part.
template <class Copy>
void for_each_piece(const NumberRows& rows, const Shape& first, const Shape& size, const Copy& copy) {
  const auto bytes = static_cast<std::size_t>(rows.number_bytes);
  for (hsize_t r = 0; r < size[0]; ++r)
    copy(rows.row(static_cast<std::int64_t>(first[0] + r)) + first[1] * bytes, r * size[1] * bytes,
         size[1] * bytes);
}

/// An open list, and how to move parts of it.
class List {
 public:
  List(Handle dataset, const Shape& shape, hid_t type)
      : dataset_(std::move(dataset)), space_(space_of(shape)), type_(type) {}

  void write(const Shape& first, const Shape& size, const std::byte* bytes) {
    check(H5Dwrite(dataset_.get(), type_, select(first, size), space_.get(), H5P_DEFAULT, bytes),
          "write a list");
  }
  void read(const Shape& first, const Shape& size, std::byte* bytes) {
    check(H5Dread(dataset_.get(), type_, select(first, size), space_.get(), H5P_DEFAULT, bytes),
          "read a list");
  }

 private:
  /// @returns the space in memory
  hid_t select(const Shape& first, const Shape& size) {
    check(H5Sselect_hyperslab(space_.get(), H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr),
          "select a part of a list");
    memory_ = space_of(size);
    return memory_.get();
  }

  Handle dataset_;
  Handle space_;
  Handle memory_ = space_of({1, 1});
  hid_t type_;
};

std::string item_path(const std::string& group, std::size_t item) {
  return fmt::format("/{}/{}", group, item);
}

bool is_plain_link(const Handle& file, const std::string& path) {
  H5L_info_t info{};
  return H5Lexists(file.get(), path.c_str(), H5P_DEFAULT) > 0 &&
         H5Lget_info(file.get(), path.c_str(), &info, H5P_DEFAULT) >= 0 && info.type == H5L_TYPE_HARD;
}

/// The dataset is stored as this program does it, and is not longer than its bytes in the file can make it.
bool is_ours(const Handle& dataset, const Shape& shape, hsize_t number_bytes) {
  const Handle list(H5Dget_create_plist(dataset.get()), H5Pclose, "read a layout");
  if (is_compact(shape, number_bytes)) return H5Pget_layout(list.get()) == H5D_COMPACT;
  Shape chunk{};
  if (H5Pget_layout(list.get()) != H5D_CHUNKED || H5Pget_chunk(list.get(), 2, chunk.data()) != 2)
    return false;
  const auto filter = [&](unsigned number) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    return H5Pget_filter2(list.get(), number, &flags, &values, nullptr, 0, nullptr, &config);
  };
  const auto bytes = static_cast<double>(shape[0]) * static_cast<double>(shape[1] * number_bytes);
  return chunk == chunk_of(shape, number_bytes) && H5Pget_nfilters(list.get()) == 2 &&
         filter(0) == H5Z_FILTER_DEFLATE && filter(1) == H5Z_FILTER_FLETCHER32 &&
         bytes <= kMostPacked * static_cast<double>(H5Dget_storage_size(dataset.get()));
}

/// A type of ours that the dataset has; nothing if there is none.
std::optional<std::pair<NumberKind, std::int64_t>> numbers_of(const Handle& dataset) {
  const Handle type(H5Dget_type(dataset.get()), H5Tclose, "read a type");
  for (const NumberKind kind : {NumberKind::unsigned_integer, NumberKind::signed_integer, NumberKind::real}) {
    for (const std::int64_t bytes : {1, 2, 4, 8}) {
      if (kind == NumberKind::real && bytes < 4) continue;  // there are none
      if (H5Tequal(type.get(), type_of(kind, bytes)) > 0) return std::pair(kind, bytes);
    }
  }
  return std::nullopt;
}

/// The shape of a dataset of ours; nothing if it is none.
std::optional<Shape> shape_of_ours(const Handle& dataset, std::int64_t number_bytes) {
  const Handle space(H5Dget_space(dataset.get()), H5Sclose, "read a shape");
  const std::vector<hsize_t> lengths = hdf5::shape_of(space);
  if (lengths.size() != 2) return std::nullopt;
  const Shape shape{lengths[0], lengths[1]};
  if (shape[0] == 0 || shape[1] == 0 || shape[0] > kMostNumbers / shape[1]) return std::nullopt;
  if (!is_ours(dataset, shape, static_cast<hsize_t>(number_bytes))) return std::nullopt;
  return shape;
}

Handle open_list(const Handle& file, const std::string& path) {
  return {H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT), H5Dclose, "open " + path};
}

void read_whole_list(const Handle& file, const std::string& path) {
  Handle dataset = open_list(file, path);
  const auto numbers = numbers_of(dataset);
  const std::optional<Shape> shape = numbers ? shape_of_ours(dataset, numbers->second) : std::nullopt;
  if (!shape) throw ResultsError("a list is none of ours");
  const auto bytes = static_cast<hsize_t>(numbers->second);
  List list(std::move(dataset), *shape, type_of(numbers->first, numbers->second));
  std::vector<std::byte> part;
  for_each_part(*shape, bytes, [&](const Shape& first, const Shape& size) {
    part.resize(size[0] * size[1] * bytes);
    list.read(first, size, part.data());
  });
}

/// Every list of every group of the root, whether or not it will be asked for.
void read_all(const std::string& path) {
  const hdf5::QuietErrors quiet;
  const Handle file = hdf5::open_file(path);
  H5G_info_t root{};
  check(H5Gget_info(file.get(), &root), "read the groups");
  for (hsize_t g = 0; g < root.nlinks; ++g) {
    std::array<char, 64> name{};
    check(static_cast<herr_t>(H5Lget_name_by_idx(file.get(), "/", H5_INDEX_NAME, H5_ITER_INC, g, name.data(),
                                                 name.size(), H5P_DEFAULT)),
          "read a name");
    const std::string group = name.data();
    if (!is_plain_link(file, "/" + group)) throw ResultsError("a group is none of ours");
    for (std::size_t item = 0; is_plain_link(file, item_path(group, item)); ++item)
      read_whole_list(file, item_path(group, item));
  }
}

}  // namespace

struct CheckpointWriter::Open {
  explicit Open(const std::string& path) : file(hdf5::create_file(path, driver)) {}
  hdf5::QuietErrors quiet;
  hdf5::OutputDriver driver;
  Handle file;
  std::string group;
  std::size_t items = 0;
  std::vector<std::byte> part;
};

CheckpointWriter::CheckpointWriter(std::string path, std::string where, std::function<void()> progress)
    : path_(std::move(path)), where_(std::move(where)), progress_(std::move(progress)) {
  guarded([this] { open_ = std::make_unique<Open>(path_); });
}

CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::guarded(const std::function<void()>& write) {
  try {
    write();
    if (open_) open_->driver.check_written("write");
  } catch (const hdf5::Failure& failure) {
    const int error = failure.system_error();
    throw IoError(error == 0 ? failure.what() : fmt::format("cannot write: {}", std::strerror(error)),
                  where_);
  }
}

void CheckpointWriter::begin(const std::string& group) {
  guarded([&] {
    open_->group = group;
    open_->items = 0;
    static_cast<void>(hdf5::create_group(open_->file, "/" + group));
  });
}

void CheckpointWriter::add(const NumberRows& rows) {
  const Shape shape = shape_of(rows);
  const auto bytes = static_cast<hsize_t>(rows.number_bytes);
  guarded([&] {
    const hid_t type = type_of(rows.kind, rows.number_bytes);
    const std::string name = item_path(open_->group, open_->items++);
    List list({H5Dcreate2(open_->file.get(), name.c_str(), type, space_of(shape).get(), H5P_DEFAULT,
                          storage_of(shape, bytes).get(), H5P_DEFAULT),
               H5Dclose, "create " + name},
              shape, type);
    for_each_part(shape, bytes, [&](const Shape& first, const Shape& size) {
      open_->part.resize(size[0] * size[1] * bytes);
      for_each_piece(rows, first, size, [&](const std::byte* row, std::size_t place, std::size_t count) {
        std::memcpy(open_->part.data() + place, row, count);
      });
      list.write(first, size, open_->part.data());
      open_->driver.check_written("write");
      if (progress_) progress_();
    });
  });
}

void CheckpointWriter::add(const std::string& text) {
  const auto length = static_cast<std::int64_t>(text.size());
  auto count = static_cast<std::uint64_t>(length);
  add(number_rows(&count, 1, 1, 1));
  if (length > 0) add(number_rows(reinterpret_cast<const unsigned char*>(text.data()), length, 1, length));
}

std::string CheckpointWriter::finish() {
  guarded([this] {
    open_->file.close("close the file");
    open_->driver.check_written("write");
  });
  open_.reset();
  return append_digest(path_, where_);
}

struct CheckpointReader::Open {
  explicit Open(const std::string& path) : file(hdf5::open_file(path)) {}

  hdf5::QuietErrors quiet;
  Handle file;
  std::string group;
  std::size_t items = 0;
  std::vector<std::byte> part;
};

namespace {

[[noreturn]] void fail_to_read(const std::string& path) {
  throw ResultsError("this checkpoint is damaged: the HDF5 library cannot read it", path);
}

}  // namespace

std::string check_checkpoint_file(const std::string& path) {
  const std::optional<std::string> digest = checked_digest(path, kSignature);
  if (!digest) throw ResultsError("this is no checkpoint, or a part of one", path);
  if (digest->empty()) throw ResultsError("this checkpoint is damaged: its checksum is wrong", path);
  try {
    try_in_child(path, [&path] { read_all(path); });
  } catch (const ResultsError&) {
    fail_to_read(path);
  }
  return *digest;
}

CheckpointReader::CheckpointReader(std::string path) : path_(std::move(path)) {
  try {
    open_ = std::make_unique<Open>(path_);
  } catch (const hdf5::Failure&) {
    fail_to_read(path_);
  }
}

CheckpointReader::~CheckpointReader() = default;

bool CheckpointReader::begin(const std::string& group) {
  open_->group = group;
  open_->items = 0;
  return is_plain_link(open_->file, "/" + group);
}

bool CheckpointReader::read(const NumberRows& rows) {
  return read_some(open_->items++, rows, 0, rows.rows);
}

bool CheckpointReader::read_some(std::size_t item, const NumberRows& rows, std::int64_t first,
                                 std::int64_t count) {
  const std::string name = item_path(open_->group, item);
  const Shape shape = {static_cast<hsize_t>(count), static_cast<hsize_t>(rows.row_length)};
  const auto begin = static_cast<hsize_t>(first), end = static_cast<hsize_t>(first + rows.rows);
  const auto bytes = static_cast<hsize_t>(rows.number_bytes);
  try {
    if (!is_plain_link(open_->file, name)) return false;
    Handle dataset = open_list(open_->file, name);
    if (numbers_of(dataset) != std::pair(rows.kind, rows.number_bytes)) return false;
    if (shape_of_ours(dataset, rows.number_bytes) != shape) return false;
    List list(std::move(dataset), shape, type_of(rows.kind, rows.number_bytes));
    for_each_part(shape, bytes, [&](const Shape& at, const Shape& whole) {
      const hsize_t top = std::max(at[0], begin), bottom = std::min(at[0] + whole[0], end);
      if (top >= bottom) return;
      const Shape size = {bottom - top, whole[1]};
      open_->part.resize(size[0] * size[1] * bytes);
      list.read({top, at[1]}, size, open_->part.data());
      const auto copy = [&](std::byte* row, std::size_t place, std::size_t length) {
        std::memcpy(row, open_->part.data() + place, length);
      };
      for_each_piece(rows, {top - begin, at[1]}, size, copy);
    });
  } catch (const hdf5::Failure&) {
    fail_to_read(path_);
  }
  return true;
}

std::string CheckpointReader::read_text() {
  std::uint64_t count = 0;
  if (!read(number_rows(&count, 1, 1, 1)) || count > kLongestText) return {};
  std::vector<unsigned char> text(count);
  const auto length = static_cast<std::int64_t>(count);
  if (count > 0 && !read(number_rows(text.data(), length, 1, length))) return {};
  const bool is_printable =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= ' ' && c < 127; });
  return is_printable ? std::string(text.begin(), text.end()) : "";
}

}  // namespace coordreq
