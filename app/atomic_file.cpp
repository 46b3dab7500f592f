#include "app/atomic_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "results/write_results.hpp"

namespace coordreq {

AtomicFile::AtomicFile(std::string path, std::string what) : path_(std::move(path)), what_(std::move(what)) {
  check_writable(path_);
}

void AtomicFile::write(std::string_view text) {
  if (!file_) {
    delay_.emplace();
    file_.emplace(path_);
    stream_.open(file_->temporary(), std::ios::binary);
  }
  if (is_interrupted()) throw interruption();
  if (!stream_.write(text.data(), static_cast<std::streamsize>(text.size()))) fail();
}

void AtomicFile::commit() {
  REQUIRES(file_.has_value());
  stream_.close();
  if (!stream_) fail();
  file_->commit();
}

void AtomicFile::fail() const {
  throw IoError(fmt::format("cannot write {}: {}", what_, std::generic_category().message(errno)), path_);
}

}  // namespace coordreq
