#include "export/report_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/requires.hpp"

namespace coordreq {

MemberMap::MemberMap(const ResultsReader& results, ReadMember read, std::vector<std::string> names,
                     std::size_t most, std::size_t most_sets)
    : results_(results),
      read_(std::move(read)),
      names_(std::move(names)),
      mapped_(std::min(names_.size(), most)),
      most_sets_(most_sets) {
  REQUIRES(1 <= most && most <= 64 && most_sets >= 2);
}

std::vector<std::int32_t> MemberMap::read(const CellBlock& block) {
  std::vector<std::int32_t> values = results_.values(paths::kCollisionTime, block);
  std::vector<std::uint64_t> sets(values.size());
  for (std::size_t member = 0; member < mapped_; ++member) {
    const std::vector<std::uint8_t> holds = read_(member, block);
    for (std::size_t x = 0; x < holds.size(); ++x) sets[x] |= std::uint64_t{holds[x]} << member;
  }
  for (std::size_t x = 0; x < values.size(); ++x)
    values[x] = values[x] == kUnbounded ? number(sets[x]) : values[x] == 0 ? -2 : -1;
  return values;
}

std::int32_t MemberMap::number(std::uint64_t set) {
  if (!fits()) return 0;
  const auto [entry, is_new] = numbers_.emplace(set, static_cast<std::int32_t>(sets_.size()));
  if (is_new) sets_.push_back(set);
  return entry->second;
}

void MemberMap::halve() {
  mapped_ = std::max<std::size_t>(mapped_ / 2, 1);
  sets_.clear();
  numbers_.clear();
}

std::vector<std::string> MemberMap::names() const {
  return {names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(mapped_)};
}

std::vector<std::string> MemberMap::sets() const {
  std::vector<std::string> texts;
  texts.reserve(sets_.size());
  for (const std::uint64_t set : sets_) texts.push_back(fmt::format("{:x}", set));
  return texts;
}

}  // namespace coordreq
