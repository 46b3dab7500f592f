#include "app/print.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/render.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {

void PrintedWarnings::print(const Json& warnings, const std::string& subject) {
  if (is_quiet_) return;
  for (const Json& entry : warnings) {
    const std::string location = line_of(entry["place"]);
    const std::string line = line_of(entry["message"]) + (location.empty() ? "" : " (" + location + ")");
    if (!lines_.insert(line).second) continue;
    const std::string start = subject.empty() ? "" : shortened(printable(subject), 200, 20) + ": ";
    write_diagnostics(fmt::format("coordreq: warning: {}{}\n", start, line));
  }
}

}  // namespace coordreq
