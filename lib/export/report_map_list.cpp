#include "export/report_maps.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "answers/field_table.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"

namespace coordreq {
namespace {

using Leading = std::optional<std::size_t>;

std::shared_ptr<Json> head_of(const Field& field) {
  auto head = std::make_shared<Json>();
  (*head)["kind"] = field.display.map.kind;
  return head;
}

/// The page learns what values mean from the flags, unless it has words of its own for the field.
ReportMap number_map(const ResultsReader& results, const Field& field, Leading leading) {
  ReportMap map{.head = head_of(field), .read = [&results, &field, leading](const CellBlock& block) {
                  return results.values(field, leading, block);
                }};
  Json& head = *map.head;
  if (leading) head[field.axes.front().substr(1)] = *leading;
  if (!field.display.map.title.empty()) {
    head["title"] = field.display.map.title;
    head["meanings"] = Json::array();
    for (auto [value, word] : flags_of(field)) {
      std::replace(word.begin(), word.end(), '_', ' ');
      head["meanings"].push_back({value == kLargestValue ? Json("infinite") : Json(value), word});
    }
  }
  if (!field.display.map.legend) return map;
  const auto found = std::make_shared<std::set<std::int32_t>>();
  map.legend = [&field, found](Json& entry) { field.display.map.legend(*found, entry); };
  map.read = [read = std::move(map.read), found](const CellBlock& block) {
    std::vector<std::int32_t> values = read(block);
    found->insert(values.begin(), values.end());
    return values;
  };
  return map;
}

ReportMap member_map(const ResultsReader& results, const Field& field, const ReportLimits& limits) {
  const auto read = [&results, &field](std::size_t member, const CellBlock& block) {
    return results.members(field, member, block);
  };
  const auto members = std::make_shared<MemberMap>(results, read, results.leading_names(field),
                                                   limits.members, limits.subsets);
  return {.head = head_of(field),
          .read = [members](const CellBlock& block) { return members->read(block); },
          .members = members};
}

/// Hundredths of a per cent; all and nothing are never the result of rounding.
std::int32_t share_code(float share) {
  constexpr std::int32_t kAll = 10000;
  if (share >= 1) return kAll;
  return std::clamp(static_cast<std::int32_t>(std::lround(share * float{kAll})), 1, kAll - 1);
}

/// 0, or 1 and hundredths of a power of ten from the least one on that is told apart; rounded up.
std::int32_t probability_code(float probability) {
  constexpr double kParts = 100, kLeast = -12;
  if (probability == 0) return 0;
  const double power = std::max(std::log10(double{probability}), kLeast);
  return 1 + static_cast<std::int32_t>(std::ceil((power - kLeast) * kParts));
}

/// A share or a probability, of one entry of the leading axis; outside K there are none.
ReportMap real_map(const ResultsReader& results, const Field& field, Leading leading) {
  const auto code = field.kind == FieldKind::share ? share_code : probability_code;
  const auto read = [&results, &field, leading, code](const CellBlock& block) {
    std::vector<std::int32_t> values = results.values(paths::kCollisionTime, block);
    const std::vector<float> reals = results.reals(field, leading, block);
    for (std::size_t x = 0; x < values.size(); ++x)
      values[x] = values[x] == kUnbounded ? code(reals[x]) : values[x] == 0 ? -2 : -1;
    return values;
  };
  ReportMap map{.head = head_of(field), .read = read};
  Json& head = *map.head;
  if (field.kind == FieldKind::share) {
    head[field.axes.front().substr(1)] = results.leading_names(field)[*leading];
    return map;
  }
  head["title"] = field.display.map.title;
  head["scale"] = "logarithm";
  head["axis"] = leading ? Json(field.axes.front().substr(1)) : Json();
  head["entry"] = leading ? Json(results.leading_names(field)[*leading]) : Json();
  return map;
}

/// All maps of a field that is not over partitions.
void add_maps(const ResultsReader& results, const Field& field, const ReportLimits& limits,
              std::vector<ReportMap>& maps) {
  const std::size_t entries = results.leading_length(field);
  const bool is_real = field.kind == FieldKind::share || field.kind == FieldKind::probability;
  if (entries == 0) {
    maps.push_back(is_real ? real_map(results, field, std::nullopt)
                           : number_map(results, field, std::nullopt));
  } else if (field.kind == FieldKind::set) {
    maps.push_back(member_map(results, field, limits));
  } else if (is_real) {
    for (std::size_t i = 0; i < std::min(entries, limits.agents); ++i)
      maps.push_back(real_map(results, field, i));
  } else {
    for (std::size_t i = 0; i < entries; ++i) maps.push_back(number_map(results, field, i));
  }
}

}  // namespace

std::vector<ReportMap> list_maps(const ResultsReader& results, const std::vector<std::size_t>& partitions,
                                 const ReportLimits& limits) {
  std::vector<const Field*> drawn;
  for (const Field& field : answer_fields(results.spec())) {
    if (!field.display.map.kind.empty() && results.has(field.path))
      drawn.push_back(&results.field(field.path));
  }
  const auto others = std::stable_partition(
      drawn.begin(), drawn.end(), [](const Field* field) { return field->axes.front() == "/partition"; });
  std::vector<ReportMap> maps;
  for (auto field = drawn.begin(); field != others; ++field) {
    for (const std::size_t p : partitions) maps.push_back(number_map(results, **field, p));
  }
  for (auto field = others; field != drawn.end(); ++field) add_maps(results, **field, limits, maps);
  return maps;
}

std::vector<PackedMap> pack_listed(const ResultsReader& results, ReportMap& map,
                                   const std::vector<ReportCells>& sets) {
  PackedMaps packed = pack_map(results.grid(), map.read, sets);
  while (map.members && !map.members->fits()) {
    map.members->halve();
    packed = pack_map(results.grid(), map.read, sets);
  }
  Json& head = *map.head;
  head["largest"] = packed.largest;
  head["flags"] = Json::array();
  for (const std::int32_t flag : packed.flags)
    head["flags"].push_back(flag == kUnbounded ? Json("infinite") : Json(flag));
  if (map.members) {
    head["members"] = map.members->names();
    head["total"] = map.members->total();
    head["sets"] = map.members->sets();
  }
  if (map.legend) map.legend(head);
  return std::move(packed.sets);
}

}  // namespace coordreq
