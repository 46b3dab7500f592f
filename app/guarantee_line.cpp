#include "app/reports.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/text.hpp"
#include "base/grouped.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

namespace {

/// "; t jumps at the sampling instants and keeps its value between", or nothing.
std::string jumping_text(const SystemSpec& spec) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.dynamics.update(i) != nullptr && !spec.dynamics.is_kept(i)) names.push_back(spec.states[i].name);
  }
  if (names.empty()) return "";
  return fmt::format("; {} {} at the sampling instants and {} between", list_text(names),
                     names.size() == 1 ? "jumps" : "jump",
                     names.size() == 1 ? "keeps its value" : "keep their values");
}

}  // namespace

std::string guarantee_of_file(const std::string& guarantee, const SystemSpec& spec) {
  return guarantee_text(guarantee) + (spec.dynamics.time == Time::discrete ? "" : jumping_text(spec));
}

std::string guarantee_line(const std::string& guarantee, const Json& motion, const SystemSpec& spec) {
  const DynamicsSpec& dynamics = spec.dynamics;
  if (dynamics.time == Time::discrete) return guarantee_text(guarantee);
  const std::string jumping = jumping_text(spec);
  if (guarantee == "continuous") return guarantee_text(guarantee) + jumping;
  std::string line = fmt::format(
      "{}: checked every {} only, {}", printable(guarantee),
      rough_amount(nearest_double(dynamics.period), dynamics.unit),
      guarantee == "samples" ? "for every point of a cell" : "where the centre of a cell is safe");
  std::size_t farthest = 0;
  // A state that jumps does not move between samples.
  const auto cells = [&](std::size_t i) {
    return dynamics.update(i) == nullptr ? motion[i]["cells"].get<double>() : 0.0;
  };
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (cells(i) > cells(farthest)) farthest = i;
  }
  if (cells(farthest) == 0) return line + jumping;
  const StateSpec& state = spec.states[farthest];
  return line +
         fmt::format("; between, {} moves up to {}", state.name,
                     rough_amount(motion[farthest]["amount"].get<double>(), state.unit)) +
         jumping;
}

}  // namespace coordreq
