#include "answers/checking/claims.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace coordreq {

std::vector<std::int64_t> Claims::integers(const std::string& path) const {
  return at(path).integers;
}

std::vector<double> Claims::numbers(const std::string& path) const {
  return at(path).numbers;
}

std::vector<std::uint64_t> Claims::list(const std::string& path) const {
  const std::vector<std::int64_t>& all = at(path).integers;
  return {all.begin(), all.end()};
}

std::vector<std::uint64_t> Claims::counted(const std::string& path) const {
  const auto found = fields.find(path);
  return found == fields.end() ? std::vector<std::uint64_t>() : found->second.cells;
}

std::int64_t Claims::attribute(const std::string& path, const std::string& name) const {
  return at(path).whole_attributes.at(name);
}

double Claims::number(const std::string& path, const std::string& name) const {
  return at(path).real_attributes.at(name);
}

void Claims::expect_length(const std::string& path, std::uint64_t length) const {
  const std::size_t found = at(path).integers.size();
  if (found != length) fail(fmt::format("found {} entries, expected {}", found, length), path);
}

void Claims::fail(const std::string& what, const std::string& path) const {
  throw ResultsError(what, file + ":" + path);
}

}  // namespace coordreq
