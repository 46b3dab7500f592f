#include "results/write_results.hpp"

#include <cstring>

#include "base/error.hpp"
#include "results/hdf5_handle.hpp"
#include "results/netcdf_writer.hpp"
#include "results/output_file.hpp"
#include "results/result_sections.hpp"

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
  file.finish();
}

}  // namespace

void write_results(const std::string& path, const ResultContent& content, ThreadTeam& team) {
  OutputFile output(path);
  const hdf5::QuietErrors quiet;
  try {
    write_content(output.temporary(), content, team);
  } catch (const hdf5::Failure& failure) {
    if (failure.system_error() == 0)
      throw IoError(std::string("cannot write the results: ") + failure.what(), path);
    throw IoError(std::string("cannot write the results: ") + std::strerror(failure.system_error()), path);
  }
  output.commit();
}

void check_writable(const std::string& path) {
  const OutputFile probe(path);
}

}  // namespace coordreq
