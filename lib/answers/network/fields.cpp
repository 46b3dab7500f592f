#include "answers/network/fields.hpp"

#include "answers/field_parts.hpp"

namespace coordreq {

Fields network_fields(const ProblemSpec& spec) {
  if (!spec.network) return {};
  std::vector<std::string> modes;
  for (const NetworkModeSpec& mode : spec.network->modes) modes.push_back(mode.name);
  const std::size_t count = modes.size();
  return {name_scale("/mode", FieldSection::names, std::move(modes), "mode of the network"),
          {.path = paths::kNetworkSafe,
           .section = FieldSection::maps,
           .types = {ElementType::uint8},
           .axes = cell_axes("/mode", spec),
           .most = 1,
           .attributes = described("from here the agents stay safe if the network is in this mode") +
                         counted_cells(count) +
                         std::vector<FieldAttribute>{flags({{0, "not_safe"}, {1, "safe"}})}}};
}

}  // namespace coordreq
