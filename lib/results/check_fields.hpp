#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "answers/field_source.hpp"
#include "results/results_file.hpp"
#include "results/results_metadata.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The fields of this spec that the file has, which are all but optional ones. Before anything is read, or
/// room is made for it, shapes, types and what is stored are compared with what the spec implies; then the
/// coordinates are.
/// @throws ResultsError naming the field; LimitError if what is not by cell needs more than `max_memory`
[[nodiscard]] Fields checked_fields(const ResultsFile& file, const ProblemSpec& spec,
                                    std::optional<std::uint64_t> max_memory);

/// Small fields as a whole.
class SmallFields : public FieldSource {
 public:
  /// @pre unchecked: both outlive this object. @param metadata with fields and what was counted
  SmallFields(const ResultsFile& file, const ResultsMetadata& metadata) : file_(file), metadata_(metadata) {}

  [[nodiscard]] bool has(const std::string& path) const override;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& path) const override;
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> list(const std::string& path) const override;
  [[nodiscard]] std::vector<std::uint64_t> counted(const std::string& path) const override;
  [[nodiscard]] std::int64_t attribute(const std::string& path, const std::string& name) const override;
  [[nodiscard]] double number(const std::string& path, const std::string& name) const override;
  void expect_length(const std::string& path, std::uint64_t length) const override;
  [[noreturn]] void fail(const std::string& what, const std::string& path) const override;

 private:
  [[nodiscard]] const Field* find(const std::string& path) const;

  const ResultsFile& file_;
  const ResultsMetadata& metadata_;
};

}  // namespace coordreq
