#include "results/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/requires.hpp"

namespace coordreq {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::string_view kSignature = "coordreq-checkpoint 3\n";
constexpr std::string_view kEnd = "end";
constexpr std::int64_t kBlockBytes = std::int64_t{1} << 18U;
constexpr std::size_t kLongestLine = 4096;

std::string type_of(const NumberRows& rows) {
  const char kind = rows.kind == NumberKind::real ? 'f' : rows.kind == NumberKind::signed_integer ? 'i' : 'u';
  return fmt::format("{}{}", kind, rows.number_bytes);
}

/// Calls `visit` with the numbers of the rows from byte `begin` on, row after row, up to byte `end`: where
/// they stand in memory, how many bytes there are in one run, and how many there were before.
template <class Visit>
void for_each_segment(const NumberRows& rows, std::int64_t begin, std::int64_t end, const Visit& visit) {
  const std::int64_t row_bytes = rows.row_bytes();
  for (std::int64_t at = begin; at < end;) {
    const std::int64_t in_row = at % row_bytes, count = std::min(row_bytes - in_row, end - at);
    visit(rows.row(at / row_bytes) + in_row, static_cast<std::size_t>(count),
          static_cast<std::size_t>(at - begin));
    at += count;
  }
}

std::string system_error() {
  return std::strerror(errno == 0 ? EIO : errno);
}

[[noreturn]] void fail(const std::string& what, const std::string& path) {
  throw ResultsError("this checkpoint is damaged: " + what, path);
}

/// The error of a read that failed, or met the end of the file.
[[noreturn]] void fail_to_read(const std::ifstream& file, const std::string& path) {
  if (file.bad()) throw IoError("cannot be read: " + system_error(), path);
  fail("it is cut short", path);
}

void read_exactly(std::ifstream& file, void* bytes, std::size_t count, const std::string& path) {
  errno = 0;
  if (!file.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count))) fail_to_read(file, path);
}

/// The packed length of a block that has `bytes` bytes unpacked.
std::uint32_t read_length(std::ifstream& file, std::int64_t bytes, const std::string& path) {
  std::uint32_t length = 0;
  read_exactly(file, &length, sizeof(length), path);
  constexpr std::int64_t kMostMore = 1024;
  if (std::int64_t{length} > bytes + bytes / 64 + kMostMore) fail("a list is none of ours", path);
  return length;
}

std::ifstream open_checkpoint(const std::string& path) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);  // a pipe would be waited for
  if (!error && !is_file) throw IoError("cannot be read: this is no regular file", path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError("cannot be read: " + system_error(), path);
  return file;
}

}  // namespace

CheckpointWriter::CheckpointWriter(const std::string& path, std::string where, const Json& header,
                                   std::function<void()> progress)
    : where_(std::move(where)),
      progress_(std::move(progress)),
      file_(path, std::ios::binary | std::ios::trunc) {
  put(fmt::format("{}{}\n", kSignature, compact_json(header)));
}

void CheckpointWriter::put(std::string_view bytes) {
  digest_.add(bytes);
  errno = 0;
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file_) throw IoError("cannot write: " + system_error(), where_);
}

std::string CheckpointWriter::put_digest() {
  std::string digest = digest_.hex();
  put(digest + "\n");
  return digest;
}

void CheckpointWriter::begin(const std::string& section, const Json& more) {
  Json head = more;
  head["section"] = section;
  put(json_line(head));
}

void CheckpointWriter::add(const NumberRows& rows) {
  const Json head = {{"type", type_of(rows)}, {"rows", rows.rows}, {"length", rows.row_length}};
  put(json_line(head));
  const std::int64_t bytes = rows.rows * rows.row_bytes();
  for (std::int64_t at = 0; at < bytes; at += kBlockBytes) {
    const std::int64_t end = std::min(at + kBlockBytes, bytes);
    block_.resize(static_cast<std::size_t>(end - at));
    for_each_segment(rows, at, end, [this](const std::byte* from, std::size_t count, std::size_t offset) {
      std::memcpy(block_.data() + offset, from, count);
    });
    put_block(static_cast<std::size_t>(rows.number_bytes));
    if (progress_) progress_();
  }
  put_digest();
}

void CheckpointWriter::put_block(std::size_t number_bytes) {
  codec_.pack(block_, number_bytes, packed_);
  const auto length = static_cast<std::uint32_t>(packed_.size());
  put({reinterpret_cast<const char*>(&length), sizeof(length)});
  put({reinterpret_cast<const char*>(packed_.data()), packed_.size()});
}

std::string CheckpointWriter::finish() {
  put(fmt::format("{}\n", kEnd));
  std::string digest = put_digest();
  errno = 0;
  file_.close();
  if (!file_) throw IoError("cannot write: " + system_error(), where_);
  return digest;
}

/// Goes through a file from its beginning to its end.
class CheckpointReader::Scan {
 public:
  explicit Scan(CheckpointReader& reader) : reader_(reader) {}

  void run() {
    read_signature();
    reader_.header_ = read_line();
    static_cast<void>(object_of(reader_.header_));
    Section* section = nullptr;
    for (std::string line = read_line(); line != kEnd; line = read_line()) {
      const Json head = object_of(line);
      if (const auto name = head.find("section"); name != head.end() && name->is_string()) {
        section = &reader_.sections_[name->get<std::string>()];
        *section = {line, {}};
      } else {
        if (section == nullptr) fail("a list is in no section");
        section->lists.push_back(read_list(head));
      }
    }
    reader_.digest_ = read_digest();
    if (reader_.file_.peek() != std::ifstream::traits_type::eof()) fail("it goes on behind its end");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { coordreq::fail(what, reader_.path_); }

  void read_signature() {
    std::string line(kSignature.size(), '\0');
    reader_.file_.read(line.data(), static_cast<std::streamsize>(line.size()));
    digest_.add(line);
    if (line == kSignature) return;
    if (line.starts_with("\x89HDF"))
      throw ResultsError("this is HDF5: a checkpoint of an earlier version of coordreq, or none",
                         reader_.path_);
    throw ResultsError("this is no checkpoint, or a part of one", reader_.path_);
  }

  std::string read_line() {
    std::array<char, kLongestLine> line{};
    errno = 0;
    reader_.file_.getline(line.data(), line.size());
    if (reader_.file_.bad() || reader_.file_.eof()) fail_to_read(reader_.file_, reader_.path_);
    if (!reader_.file_) fail("a line is none of ours");
    std::string result(line.data(), static_cast<std::size_t>(reader_.file_.gcount()) - 1);
    digest_.add(result + '\n');
    return result;
  }

  [[nodiscard]] Json object_of(const std::string& line) const {
    Json json = parse_json_if_valid(line);
    if (!json.is_object()) fail("a line is none of ours");
    return json;
  }

  List read_list(const Json& head) {
    const auto type = head.find("type");
    List list{.type = type != head.end() && type->is_string() ? type->get<std::string>() : "",
              .rows = integer_or_zero(head, "rows"),
              .length = integer_or_zero(head, "length"),
              .offset = reader_.file_.tellg()};
    const std::int64_t number_bytes = list.type.size() == 2 ? list.type[1] - '0' : 0;
    std::int64_t bytes = 0;
    if (number_bytes < 1 || list.rows < 1 || list.length < 1 ||
        __builtin_mul_overflow(list.rows, list.length, &bytes) || bytes > kMostNumbers)
      fail("a list is none of ours");
    bytes *= number_bytes;
    for (std::int64_t at = 0; at < bytes; at += kBlockBytes) read_block(std::min(kBlockBytes, bytes - at));
    static_cast<void>(read_digest());
    return list;
  }

  void read_block(std::int64_t bytes) {
    const std::uint32_t length = read_length(reader_.file_, bytes, reader_.path_);
    digest_.add({reinterpret_cast<const char*>(&length), sizeof(length)});
    packed_.resize(length);
    read_exactly(reader_.file_, packed_.data(), packed_.size(), reader_.path_);
    digest_.add(packed_);
  }

  /// @returns that of all before it
  std::string read_digest() {
    std::string digest = digest_.hex();
    if (read_line() != digest) fail("its checksum is wrong");
    return digest;
  }

  static constexpr std::int64_t kMostNumbers = std::int64_t{1} << 48U;

  CheckpointReader& reader_;
  Sha256 digest_;
  std::string packed_;
};

CheckpointReader::CheckpointReader(const std::string& path) : path_(path), file_(open_checkpoint(path)) {
  Scan(*this).run();
}

Json CheckpointReader::header() const {
  return parse_json(header_);
}

Json CheckpointReader::begin(const std::string& section) {
  const auto found = sections_.find(section);
  section_ = found == sections_.end() ? nullptr : &found->second;
  item_ = 0;
  return section_ == nullptr ? Json() : parse_json(section_->head);
}

bool CheckpointReader::read(const NumberRows& rows) {
  return read_some(item_++, rows, 0, rows.rows);
}

bool CheckpointReader::read_some(std::size_t item, const NumberRows& rows, std::int64_t first,
                                 std::int64_t count) {
  REQUIRES(0 <= first && first + rows.rows <= count);
  if (section_ == nullptr || item >= section_->lists.size()) return false;
  const List& list = section_->lists[item];
  if (list.type != type_of(rows) || list.rows != count || list.length != rows.row_length) return false;
  const std::int64_t row_bytes = rows.row_bytes(), bytes = count * row_bytes;
  const std::int64_t begin = first * row_bytes, end = begin + rows.rows * row_bytes;
  file_.clear();
  file_.seekg(list.offset);
  for (std::int64_t at = 0; at < end; at += kBlockBytes) {
    const std::int64_t size = std::min(kBlockBytes, bytes - at);
    packed_.resize(read_length(file_, size, path_));
    if (at + size <= begin) {
      file_.seekg(static_cast<std::streamoff>(packed_.size()), std::ios::cur);
      continue;
    }
    read_exactly(file_, packed_.data(), packed_.size(), path_);
    if (!unpack_chunk(packed_, static_cast<std::size_t>(size), true,
                      static_cast<std::size_t>(rows.number_bytes), block_))
      fail("a list cannot be unpacked", path_);
    const std::int64_t from = std::max(at, begin), to = std::min(at + size, end);
    for_each_segment(rows, from - begin, to - begin,
                     [&](std::byte* target, std::size_t count_of, std::size_t offset) {
                       std::memcpy(target, block_.data() + (from - at) + offset, count_of);
                     });
  }
  return true;
}

}  // namespace coordreq
