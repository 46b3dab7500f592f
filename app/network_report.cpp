#include "app/network_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/render.hpp"
#include "spec/coordination_spec.hpp"

namespace coordreq {

std::string more_modes(std::size_t modes) {
  return modes <= kMostModes ? "" : fmt::format("  ... and {} more modes\n", grouped(modes - kMostModes));
}

std::string modes_text(const Json& modes) {
  Table table({Table::Align::left, Table::Align::right});
  table.add({"mode of the network", "safe cells"});
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode)
    table.add({line_of(modes[mode]["name"]), grouped(modes[mode]["cells"])});
  return table.text() + more_modes(modes.size());
}

}  // namespace coordreq
