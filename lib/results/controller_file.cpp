#include "results/controller_file.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "results/sha256.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

enum class Kind { hdf5, scots };

Kind kind_of(const std::string& path) {
  std::error_code ignored;  // what cannot be examined fails to open below
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw IoError("is a folder, expected a file with a controller", path);
  // It is read more than once, and a pipe could keep the program indefinitely.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw IoError("is a device, a pipe or a socket, expected a file with a controller", path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw IoError("cannot read the controller: " + std::generic_category().message(errno == 0 ? EIO : errno),
                  path);
  }
  std::array<char, 8> bytes{};
  file.read(bytes.data(), bytes.size());
  const std::string_view first(bytes.data(), static_cast<std::size_t>(file.gcount()));
  if (first == "\x89HDF\r\n\x1a\n") return Kind::hdf5;
  if (first.substr(0, 7) == "#SCOTS:") return Kind::scots;
  throw ControllerError("no controller: expected an HDF5 file or a SCOTS file, which begins with '#SCOTS:'",
                        path);
}

/// The spec of a controller that knows nothing of memories.
ProblemSpec without_memory(ProblemSpec spec) {
  for (std::size_t i = spec.states.size(); i-- > 0;) {
    if (spec.dynamics.is_kept(i)) spec.states.pop_back();  // they come last
  }
  return spec;
}

PackedPairs read_pairs(const std::string& path, Kind kind, const ProblemSpec& spec) {
  return kind == Kind::hdf5 ? read_stored_controller(path, spec) : read_scots_controller(path, spec);
}

void check_pairs(const std::string& path, Kind kind, const ProblemSpec& spec) {
  kind == Kind::hdf5 ? check_stored_controller(path, spec) : check_scots_controller(path, spec);
}

/// Pairs in which each cell stands for `copies` cells.
PackedPairs repeated(const PackedPairs& pairs, std::int64_t copies) {
  PackedPairs result{.inputs = pairs.inputs, .bytes = {}};
  const auto width = static_cast<std::ptrdiff_t>(pairs.bytes_per_cell());
  for (auto cell = pairs.bytes.begin(); cell != pairs.bytes.end(); cell += width) {
    for (std::int64_t k = 0; k < copies; ++k) result.bytes.insert(result.bytes.end(), cell, cell + width);
  }
  return result;
}

/// Whether the file lists what holds whatever memories keep. @throws as check_pairs() does if it is neither
/// that nor a file for the spec
bool ignores_memory(const std::string& path, Kind kind, const ProblemSpec& spec) {
  if (!spec.memory.empty()) {
    try {
      check_pairs(path, kind, without_memory(spec));
      return true;
    } catch (const Error&) {  // then it is a file with all axes, or none that fits
    }
  }
  check_pairs(path, kind, spec);
  return false;
}

}  // namespace

std::string controller_path(const ProblemSpec& spec) {
  REQUIRES(spec.controller.file.has_value());
  return (std::filesystem::path(spec.folder) / *spec.controller.file).string();
}

void check_controller_file(const ProblemSpec& spec) {
  const std::string path = controller_path(spec);
  static_cast<void>(ignores_memory(path, kind_of(path), spec));
}

ListedController read_controller_file(const ProblemSpec& spec) {
  REQUIRES(spec.controller.file.has_value());
  const std::string path = controller_path(spec);
  const Kind kind = kind_of(path);
  ListedController listed{.sha256 = sha256_of_file(path), .pairs = {}};
  if (!ignores_memory(path, kind, spec)) {
    listed.pairs = read_pairs(path, kind, spec);
    return listed;
  }
  std::int64_t copies = 1;
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    copies *= spec.dynamics.is_kept(i) ? spec.states[i].grid.count : 1;
  listed.pairs = repeated(read_pairs(path, kind, without_memory(spec)), copies);
  return listed;
}

}  // namespace coordreq
