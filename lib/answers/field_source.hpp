#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace coordreq {

/// A source of small fields, whose shapes are as declared: a results file, or claims that were read from one.
class FieldSource {
 public:
  virtual ~FieldSource() = default;
  /// Whether the source has an optional scale.
  [[nodiscard]] virtual bool has(const std::string& path) const = 0;
  [[nodiscard]] virtual std::vector<std::int64_t> integers(const std::string& path) const = 0;
  [[nodiscard]] virtual std::vector<double> numbers(const std::string& path) const = 0;
  /// Numbers that are not negative; not compared with the field's least and most.
  [[nodiscard]] virtual std::vector<std::uint64_t> list(const std::string& path) const = 0;
  /// The attribute `cells`; empty if there is no field or no attribute.
  [[nodiscard]] virtual std::vector<std::uint64_t> counted(const std::string& path) const = 0;
  /// An attribute of a field: an integer, or a floating point number.
  [[nodiscard]] virtual std::int64_t attribute(const std::string& path, const std::string& name) const = 0;
  [[nodiscard]] virtual double number(const std::string& path, const std::string& name) const = 0;
  /// @throws ResultsError if a list has another length
  virtual void expect_length(const std::string& path, std::uint64_t length) const = 0;
  /// @throws ResultsError that names the file and the field
  [[noreturn]] virtual void fail(const std::string& what, const std::string& path) const = 0;
};

}  // namespace coordreq
