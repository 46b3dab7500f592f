#include "results/appended_digest.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "base/error.hpp"
#include "results/sha256.hpp"

namespace coordreq {
namespace {

constexpr std::uint64_t kBytes = 64;  // as text

}  // namespace

std::string append_digest(const std::string& path, const std::string& where) {
  std::ofstream end(path, std::ios::binary | std::ios::app);
  std::string digest = sha256_of_file(path);
  end << digest;
  end.close();
  if (!end) throw IoError("cannot write: " + std::string(std::strerror(errno)), where);
  return digest;
}

std::optional<std::string> checked_digest(const std::string& path, std::string_view signature) {
  std::ifstream file(path, std::ios::binary);
  std::string beginning(signature.size(), '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (file.bad()) throw IoError("cannot be read: " + std::string(std::strerror(errno)), path);
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(file.tellg());
  std::string digest(kBytes, '\0');
  if (size > kBytes) file.seekg(static_cast<std::streamoff>(size - kBytes));
  file.read(digest.data(), static_cast<std::streamsize>(digest.size()));
  const bool is_digest = digest.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (size <= kBytes || beginning != signature || !is_digest) return std::nullopt;
  return sha256_of_file(path, kBytes) == digest ? digest : "";
}

}  // namespace coordreq
