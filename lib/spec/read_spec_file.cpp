#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <istream>
#include <memory>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

std::string read_all(std::istream& stream, const std::string& name) {
  std::string text;
  std::array<char, 65'536> block{};
  do {
    // read() turns a failing system call into badbit; an iterator over the buffer would let it throw.
    stream.read(block.data(), block.size());
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) throw IoError("cannot be read", name);
  return text;
}

/// A pipe is read once somebody writes to it, who has five seconds to begin.
std::string read_pipe(const std::string& path) {
  constexpr int kAttempts = 100;
  constexpr int kPauseMs = 50;
  const int pipe = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (pipe < 0) throw IoError("cannot be read: " + std::generic_category().message(errno), path);
  const std::unique_ptr<const int, void (*)(const int*)> closer(&pipe, [](const int* file) { close(*file); });
  std::string text;
  std::array<char, 65'536> block{};
  bool has_writer = false;
  for (int attempt = 0; attempt < kAttempts;) {
    const ssize_t count = read(pipe, block.data(), block.size());
    pollfd wanted{pipe, POLLIN, 0};
    if (count > 0) {
      text.append(block.data(), static_cast<std::size_t>(count));
      has_writer = true;
    } else if (count == 0 && has_writer) {
      return text;
    } else if (count == 0) {
      poll(nullptr, 0, kPauseMs);
      ++attempt;
    } else if (errno == EAGAIN) {
      has_writer = true;
      poll(&wanted, 1, -1);
    } else if (errno != EINTR) {
      throw IoError("cannot be read: " + std::generic_category().message(errno), path);
    }
  }
  throw IoError("is a pipe that nobody writes to, expected a spec", path);
}

/// Why a file could not be opened, in the system's words.
std::string reason(int error) {
  return error == 0 ? "cannot be read" : "cannot be read: " + std::generic_category().message(error);
}

}  // namespace

SpecSource read_spec_source(const std::string& path, std::istream& standard_input) {
  if (path == "-") return {read_all(standard_input, "standard input"), "standard input", ""};
  std::error_code ignored;  // what cannot be examined fails to open below
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found) throw IoError("no such file", path);
  if (std::filesystem::is_directory(status)) throw IoError("is a folder, expected a spec file", path);
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    throw IoError("is a device, expected a spec file", path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (std::filesystem::is_fifo(status)) return {read_pipe(path), path, folder};
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(reason(errno), path);
  return {read_all(file, path), path, folder};
}

ProblemSpec read_spec(SpecSource source) {
  ProblemSpec spec = read_spec(std::move(source.text), source.name);
  spec.folder = std::move(source.folder);
  return spec;
}

ProblemSpec read_spec_file(const std::string& path, std::istream& standard_input) {
  return read_spec(read_spec_source(path, standard_input));
}

}  // namespace coordreq
