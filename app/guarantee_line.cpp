#include "app/guarantee_line.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/text.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

std::string guarantee_line(const std::string& guarantee, const Json& motion, const SystemSpec& spec) {
  const DynamicsSpec& dynamics = spec.dynamics;
  if (dynamics.time == Time::discrete || guarantee == "continuous") return guarantee_text(guarantee);
  std::string line = fmt::format(
      "{}: checked every {} only, {}", printable(guarantee),
      rough_amount(nearest_double(dynamics.period), dynamics.unit),
      guarantee == "samples" ? "for every point of a cell" : "where the centre of a cell is safe");
  std::size_t farthest = 0;
  const auto cells = [&](std::size_t i) { return motion[i]["cells"].get<double>(); };
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (cells(i) > cells(farthest)) farthest = i;
  }
  if (cells(farthest) == 0) return line;
  const StateSpec& state = spec.states[farthest];
  return line + fmt::format("; between, {} moves up to {}", state.name,
                            rough_amount(motion[farthest]["amount"].get<double>(), state.unit));
}

}  // namespace coordreq
