#include "results/sha256.hpp"

#include <nettle/sha2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

#include "base/error.hpp"

namespace coordreq {
namespace {

class Digest {
 public:
  Digest() { sha256_init(&context_); }

  void add(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }

  std::string hex() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&context_, digest.size(), digest.data());
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    for (const std::uint8_t byte : digest) {
      hex += kDigits[byte >> 4U];
      hex += kDigits[byte & 15U];
    }
    return hex;
  }

 private:
  sha256_ctx context_{};
};

}  // namespace

std::string sha256_hex(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.hex();
}

std::string sha256_of_file(const std::string& path, std::uint64_t left_out) {
  Digest digest;
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::uint64_t left = std::numeric_limits<std::uint64_t>::max();
  if (left_out > 0) {
    std::error_code ignored;  // then it cannot be read, either
    const std::uint64_t size = std::filesystem::file_size(path, ignored);
    left = ignored || size < left_out ? 0 : size - left_out;
  }
  std::string block(1U << 16U, '\0');
  while (file && left > 0) {
    file.read(block.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(block.size(), left)));
    const auto count = static_cast<std::uint64_t>(file.gcount());
    digest.add({block.data(), count});
    left -= count;
  }
  if (left > 0 && !file.eof())
    throw IoError("cannot be read: " + std::generic_category().message(errno == 0 ? EIO : errno), path);
  return digest.hex();
}

}  // namespace coordreq
