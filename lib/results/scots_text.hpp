#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace coordreq {

/// The lines of a SCOTS file, one after the other. Blank lines and blanks at the ends of lines do not count.
class ScotsText {
 public:
  /// @throws IoError
  explicit ScotsText(const std::string& path);

  /// The next line; a text that ends is an error that names what was `wanted`.
  std::string_view next(std::string_view wanted);
  /// Reads a line that must be `expected`.
  void expect(std::string_view expected);
  /// "#MEMBER:NAME" and its value.
  std::int64_t member(std::string_view name);
  /// "#VECTOR:NAME", "#BEGIN:n", n numbers, "#END". @throws ControllerError unless n is `count`
  struct Entry {
    double value = 0;
    std::int64_t line = 0;
  };
  std::vector<Entry> vector(std::string_view name, std::size_t count);
  /// The numbers after "#BEGIN:".
  std::vector<std::int64_t> begin();

  /// Natural numbers, blanks between; @throws ControllerError
  [[nodiscard]] std::vector<std::int64_t> naturals(std::string_view text) const;
  [[nodiscard]] std::string place() const { return place(line_number_); }
  [[nodiscard]] std::string place(std::int64_t line) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::string line_;
  std::int64_t line_number_ = 0;
};

}  // namespace coordreq
