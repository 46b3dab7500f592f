#include "results/controller_file.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "results/scots_controller.hpp"
#include "results/sha256.hpp"
#include "results/stored_controller.hpp"

namespace coordreq {
namespace {

enum class Kind { hdf5, scots };

Kind kind_of(const std::string& path) {
  std::error_code ignored;  // what cannot be examined fails to open below
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw IoError("is a folder, expected a file with a controller", path);
  // It is read more than once, and a pipe could keep the program for ever.
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

}  // namespace

std::string controller_path(const ProblemSpec& spec) {
  return (std::filesystem::path(spec.folder) / *spec.controller.file).string();
}

void check_controller_file(const ProblemSpec& spec) {
  const std::string path = controller_path(spec);
  if (kind_of(path) == Kind::hdf5) {
    check_stored_controller(path, spec);
  } else {
    check_scots_controller(path, spec);
  }
}

ListedController read_controller_file(const ProblemSpec& spec) {
  const std::string path = controller_path(spec);
  const Kind kind = kind_of(path);
  return {
      .sha256 = sha256_of_file(path),
      .pairs = kind == Kind::hdf5 ? read_stored_controller(path, spec) : read_scots_controller(path, spec)};
}

}  // namespace coordreq
