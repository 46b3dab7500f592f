#include <fmt/format.h>

#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/network/answer.hpp"
#include "answers/network/network_meaning.hpp"
#include "answers/paths.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Whether each mode of the network is safe from a cell.
Fields network_fields(const ProblemSpec& spec) {
  if (!spec.network) return {};
  std::vector<std::string> modes;
  for (const NetworkModeSpec& mode : spec.network->modes) modes.push_back(mode.name);
  const std::size_t count = modes.size();
  return {
      name_scale("/mode", FieldSection::names, std::move(modes), "mode of the network"),
      {.path = paths::kNetworkSafe,
       .kind = FieldKind::set,
       .section = FieldSection::maps,
       .types = {ElementType::uint8},
       .axes = cell_axes("/mode", spec),
       .most = 1,
       .attributes = described("from here the agents stay safe if the network is in this mode") +
                     counted_cells(count) +
                     std::vector<FieldAttribute>{flags({{0, "not_safe"}, {1, "safe"}})},
       .display = {.query = {.name = "safe_modes",
                             .label = "safe in",
                             .heading = fmt::format("network {}: {}", network_kind_name(spec.network->kind),
                                                    network_meaning(*spec.network)),
                             .entry = "mode"},
                   .map = {.kind = "modes"}}}};
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_network_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const network = answers.find<NetworkSafety>();
  if (network == nullptr) return;
  std::vector<std::uint64_t> cells;
  for (const CellSet& safe : network->safe)
    cells.push_back(static_cast<std::uint64_t>(answers.context.count(safe)));
  values.entries[paths::kNetworkSafe] = {.array = sets_array(network->safe, *answers.context.order),
                                         .attributes = {{"cells", std::move(cells)}}};
}

}  // namespace coordreq
