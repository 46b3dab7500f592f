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

std::string network_meaning(const NetworkSpec& network) {
  switch (network.kind) {
    case NetworkKind::delay:
      return fmt::format("connected after {}", count_of(network.delay, "step"));
    case NetworkKind::burst:
      return fmt::format("at most {} lost in a row, at least {} connected between",
                         count_of(network.burst_length, "step"), grouped(network.burst_gap));
    case NetworkKind::weakly_hard:
      return fmt::format("at most {} of any {} lost", grouped(network.misses),
                         count_of(network.window, "step"));
    case NetworkKind::automaton:
      break;
  }
  return count_of(static_cast<std::int64_t>(network.modes.size()), "mode") + " with given transitions";
}

std::string modes_text(const Json& modes) {
  Table table({Table::Align::left, Table::Align::right});
  table.add({"mode of the network", "safe cells"});
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode)
    table.add({line_of(modes[mode]["name"]), grouped(modes[mode]["cells"])});
  return table.text() + more_modes(modes.size());
}

std::vector<std::string> safe_mode_names(const NetworkSpec& network, const std::vector<bool>& safe) {
  std::vector<std::string> names;
  for (std::size_t mode = 0; mode < safe.size(); ++mode) {
    if (safe[mode]) names.push_back(network.modes[mode].name);
  }
  return names;
}

std::string safe_modes_text(const NetworkSpec& network, std::vector<std::string> names) {
  const std::size_t count = names.size(), all = network.modes.size();
  std::string text = count == 0     ? "no mode"
                     : count == all ? fmt::format("all {} modes", grouped(std::uint64_t{count}))
                                    : fmt::format("{} of {} modes", grouped(std::uint64_t{count}),
                                                  grouped(std::uint64_t{all}));
  if (count > 0 && count < all) {
    names.resize(std::min(kMostModes, count));
    text += fmt::format(": {}{}", fmt::join(names, ", "), count > kMostModes ? " ..." : "");
  }
  return fmt::format("\nnetwork {}: {}\n  safe in  {}\n", network_kind_name(network.kind),
                     network_meaning(network), text);
}

}  // namespace coordreq
