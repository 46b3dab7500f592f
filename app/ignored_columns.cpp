#include "app/print.hpp"

#include <fmt/format.h>

#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "spec/wording.hpp"

namespace coordreq {

void IgnoredColumns::warn(const std::vector<std::string>& names, const std::string& hint) {
  if (is_reported_ || names.empty()) return;
  is_reported_ = true;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + quote_text(name);
  write_diagnostics(fmt::format("coordreq: warning: {} is called {}: ignored{} ({})\n", what_, list, hint,
                                printable(source_)));
}

}  // namespace coordreq
