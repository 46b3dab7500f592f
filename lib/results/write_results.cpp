#include "results/write_results.hpp"

#include "results/netcdf_writer.hpp"
#include "results/output_file.hpp"
#include "results/requirement_sections.hpp"
#include "results/result_sections.hpp"
#include "results/whole_file.hpp"

namespace coordreq {
namespace {

void write_content(const std::string& path, const ResultContent& content, ThreadTeam& team) {
  NetcdfWriter file(path, team);
  write_header(file, content);
  write_axes(file, content);
  write_sets(file, content);
  write_delays(file, content);
  write_layers(file, content);
  write_actions(file, content);
  write_abstraction(file, content);
  write_maps(file, content);
  write_requirements(file, content);
  file.finish();
}

}  // namespace

void write_results(const std::string& path, const ResultContent& content, ThreadTeam& team) {
  write_whole_file(path, "the results",
                   [&](const std::string& temporary) { write_content(temporary, content, team); });
}

void check_writable(const std::string& path) {
  const OutputFile probe(path);
}

}  // namespace coordreq
