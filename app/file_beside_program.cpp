#include "app/file_beside_program.hpp"

#include <filesystem>
#include <system_error>

namespace coordreq {

std::optional<std::string> file_beside_program(const std::string& installed, const std::string& in_sources) {
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path();  // bin, or build/PRESET/app
  if (error) return std::nullopt;
  for (const std::filesystem::path& path :
       {folder.parent_path() / installed, folder.parent_path().parent_path().parent_path() / in_sources}) {
    if (std::filesystem::is_regular_file(path, error)) return path.string();
  }
  return std::nullopt;
}

}  // namespace coordreq
