#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace coordreq::test {

/// Tells libFuzzer that an answer was met, so that the first input that leads to it is kept; answers that
/// differ in numbers or names only are often the same. What guides it where the code is not instrumented.
void note_answer(std::string_view text);

/// Does what a command does with foreign input. An Error is an answer; whatever else is thrown, and every
/// report of a sanitiser, is a finding.
template <class Work>
void answers(const Work& work) {
  try {
    work();
    note_answer({});
  } catch (const Error& error) {
    note_answer(error.what());
  }
}

/// The input as text.
inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return std::string(reinterpret_cast<const char*>(data), size);
}

/// A file in memory with the input as its content, for readers that take a path.
class InputFile {
 public:
  /// A place for one.
  [[nodiscard]] static std::string new_path();

  InputFile(const std::uint8_t* data, std::size_t size);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A spec of a few cells that readers of controllers and checkpoints compare their file with.
[[nodiscard]] std::string_view small_spec();

}  // namespace coordreq::test
