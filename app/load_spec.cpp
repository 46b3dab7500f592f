#include "app/load_spec.hpp"

#include <iostream>
#include <utility>

#include "app/sweep.hpp"
#include "results/controller_file.hpp"

namespace coordreq {

void declare_settings(Options& options, std::vector<SpecSetting>& settings) {
  options.repeatable(
      settings, "--set", "PATH=VALUE",
      "Take another value in the spec, as constants.R=0.7 or states.0.step=0.02; may be repeated",
      parse_setting);
}

SpecSource with_settings(SpecSource source, const std::vector<SpecSetting>& settings) {
  for (const SpecSetting& setting : settings) source.text = with_setting(source.text, source.name, setting);
  return source;
}

void add_read_files(const std::string& path, const ProblemSpec* spec, FilesInUse& files) {
  files.reads(path, "the spec");
  if (spec != nullptr && spec->controller.file) files.reads(controller_path(*spec), "the controller");
}

ProblemSpec load_spec(const std::string& path, const std::vector<SpecSetting>& settings) {
  return read_spec(with_settings(read_spec_source(path, std::cin), settings));
}

}  // namespace coordreq
