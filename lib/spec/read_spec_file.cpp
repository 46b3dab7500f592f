#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <istream>
#include <memory>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "spec/read_spec.hpp"
#include "spec/read_tables.hpp"
#include "spec/spec_location.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26U;

void append(const char* bytes, std::size_t count, const std::string& name, std::string& text) {
  if (text.size() + count > kMostBytes) throw LimitError("longer than 64 MiB, expected a spec", name);
  text.append(bytes, count);
}

std::string read_all(std::istream& stream, const std::string& name) {
  std::string text;
  std::array<char, 65'536> block{};
  do {
    // read() turns a failing system call into badbit; an iterator over the buffer would let it throw.
    stream.read(block.data(), block.size());
    append(block.data(), static_cast<std::size_t>(stream.gcount()), name, text);
  } while (stream);
  if (stream.bad()) throw IoError("cannot be read", name);
  return text;
}

[[noreturn]] void fail(int error, const std::string& path) {
  throw IoError("cannot be read: " + std::generic_category().message(error), path);
}

/// An open file. A pipe is waited for until somebody has opened its other end, and then until that is closed:
/// there is no saying how long a program takes that makes a spec.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path)
      : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0) fail(errno, path_);
  }
  ~OpenFile() { ::close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] std::string text() {
    std::string text;
    struct stat status {};
    if (::fstat(file_, &status) == 0 && S_ISREG(status.st_mode))
      text.reserve(std::min(kMostBytes, static_cast<std::size_t>(status.st_size)));
    std::array<char, 65'536> block{};
    while (true) {
      const ssize_t count = ::read(file_, block.data(), block.size());
      if (count == 0) return text;
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(errno, path_);
      append(block.data(), static_cast<std::size_t>(count), path_, text);
    }
  }

 private:
  const std::string& path_;
  int file_;
};

}  // namespace

SpecSource read_spec_source(const std::string& path, std::istream& standard_input) {
  if (path == "-") return {read_all(standard_input, "standard input"), "standard input", ""};
  std::error_code ignored;  // what cannot be examined fails to open below
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found) throw IoError("no such file", path);
  if (std::filesystem::is_directory(status)) throw IoError("is a folder, expected a spec file", path);
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    throw IoError("is a device, expected a spec file", path);
  return {OpenFile(path).text(), path, std::filesystem::path(path).parent_path().string()};
}

ProblemSpec read_spec(SpecSource source) {
  SpecWithTables whole = with_table_files(source);
  ProblemSpec spec = read_spec(std::move(whole.text), source.name);
  if (!whole.files.empty()) {
    spec.written =
        std::make_shared<const WrittenSpec>(WrittenSpec{std::move(source.text), {}, std::move(whole.files)});
  }
  spec.folder = std::move(source.folder);
  return spec;
}

ProblemSpec read_spec_file(const std::string& path, std::istream& standard_input) {
  return read_spec(read_spec_source(path, standard_input));
}

}  // namespace coordreq
