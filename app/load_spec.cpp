#include "app/load_spec.hpp"

#include <iostream>
#include <utility>

namespace coordreq {

SpecSource with_settings(SpecSource source, const std::vector<SpecSetting>& settings) {
  for (const SpecSetting& setting : settings) source.text = with_setting(source.text, source.name, setting);
  return source;
}

ProblemSpec load_spec(const std::string& path, const std::vector<SpecSetting>& settings) {
  return read_spec(with_settings(read_spec_source(path, std::cin), settings));
}

}  // namespace coordreq
