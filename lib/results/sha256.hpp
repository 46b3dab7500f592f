#pragma once

#include <nettle/sha2.h>

#include <string>
#include <string_view>

namespace coordreq {

/// SHA-256 (FIPS 180-4) of bytes that come one after the other.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// The digest of all bytes so far, as 64 lower-case hexadecimal digits.
  [[nodiscard]] std::string hex() const;

 private:
  sha256_ctx context_;
};

/// The digest of `text`, in hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view text);

/// The digest of a file, in hexadecimal digits. @throws IoError
[[nodiscard]] std::string sha256_of_file(const std::string& path);

}  // namespace coordreq
