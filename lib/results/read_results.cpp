#include "results/read_results.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "results/child_trial.hpp"
#include "results/read_requirements.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"
#include "results/results_paths.hpp"

namespace coordreq {
namespace {

void read_attributes(const ResultsFile& file, ResultInfo& info) {
  info.name = file.text("/", "title");
  info.coordreq_version = file.text("/", "coordreq_version");
  info.git_sha1 = file.text("/", "git_sha1");
  info.spec_sha256 = file.text("/", "spec_sha256");
  info.guarantee = file.text("/", "guarantee");
  info.period = file.number("/", "period");
  info.period_unit = file.text("/", "period_unit");
}

ResultInfo::Axis read_axis(const ResultsFile& file, const std::string& name) {
  const std::string path = "/" + name;
  const std::vector<double> points = file.numbers(path);
  if (file.shape(path).size() != 1 || points.empty()) {
    throw ResultsError("not a list of grid points", file.place(path));
  }
  const std::string unit = file.text(path, "units");
  return {name, unit == "1" ? "" : unit, points.size(), points.front(), points.back()};
}

void read_axes(const ResultsFile& file, ResultInfo& info) {
  info.cells = 1;
  for (const std::string& name : file.axes("/safe")) {
    info.states.push_back(read_axis(file, name));
    info.cells *= info.states.back().points;
  }
  for (const std::string& name : file.members("/")) {
    const std::string path = "/" + name;
    if (file.has(path, "role") && file.text(path, "role") == "input") {
      info.inputs.push_back(read_axis(file, name));
    }
  }
}

void check_shapes(const ResultsFile& file, const ResultInfo& info, std::uint64_t partitions) {
  std::vector<std::uint64_t> shape;
  for (const ResultInfo::Axis& axis : info.states) shape.push_back(axis.points);
  for (const char* path : {"/safe", "/invariant", "/collision_time"}) file.expect_shape(path, shape);
  shape.insert(shape.begin(), partitions);
  for (const char* path : {"/delay", "/trigger"}) file.expect_shape(path, shape);
  file.expect_shape("/fixed_point_index", {partitions});
  const std::vector<std::uint64_t> layer = file.shape("/layer");
  if (layer.size() != 1 || layer.front() == 0) throw ResultsError("not a list", file.place("/layer"));
  file.expect_shape("/layer_size", {partitions, layer.front()});
  file.expect_shape("/spec", {});
}

void read_partitions(const ResultsFile& file, ResultInfo& info) {
  const std::vector<std::string> names = file.texts("/partition");
  check_shapes(file, info, names.size());
  const std::vector<std::int64_t> fixed_points = file.integers("/fixed_point_index");
  const std::vector<std::int64_t> sizes = file.integers("/layer_size");
  const auto layers = static_cast<std::int64_t>(file.shape("/layer").front());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::int64_t fixed_point = fixed_points[i];
    if (fixed_point < -1 || fixed_point >= layers) {
      throw ResultsError("found " + std::to_string(fixed_point) + ", expected a layer or -1",
                         file.place("/fixed_point_index"));
    }
    const auto row = sizes.begin() + static_cast<std::int64_t>(i) * layers;
    const std::int64_t known = fixed_point < 0 ? layers : fixed_point + 1;
    info.partitions.push_back({names[i], static_cast<std::int32_t>(fixed_point), {row, row + known}});
  }
}

void read_modes(const ResultsFile& file, ResultInfo& info) {
  if (!file.exists(paths::kNetworkSafe)) return;
  const std::vector<std::string> names = file.texts(paths::kMode);
  const std::vector<std::uint64_t> cells = file.naturals(paths::kNetworkSafe, "cells");
  if (cells.size() != names.size()) {
    throw ResultsError("the attribute cells does not hold a number a mode", file.place(paths::kNetworkSafe));
  }
  for (std::size_t mode = 0; mode < names.size(); ++mode) info.modes.push_back({names[mode], cells[mode]});
}

ResultInfo::Coalition read_coalition(const ResultsFile& file, std::size_t partitions) {
  ResultInfo::Coalition coalition;
  coalition.horizon = file.integer(paths::kCoalition, "horizon");
  if (file.has(paths::kCoalition, "cells"))
    coalition.cells = file.integers(paths::kCoalition, "cells", partitions);
  if (!file.exists(paths::kCriticalPair)) return coalition;
  const std::vector<std::string> pairs = file.texts(paths::kPair);
  if (pairs.empty()) throw ResultsError("not a list of pairs", file.place(paths::kPair));
  if (!file.has(paths::kCriticalPair, "cells")) return coalition;
  const std::vector<std::int64_t> cells = file.integers(paths::kCriticalPair, "cells", pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) coalition.critical_pairs.emplace_back(pairs[i], cells[i]);
  return coalition;
}

std::vector<std::string> names_of(const std::vector<ResultInfo::Axis>& axes) {
  std::vector<std::string> names;
  for (const ResultInfo::Axis& axis : axes) names.push_back(axis.name);
  return names;
}

ResultInfo read(const std::string& path) {
  const ResultsFile file(path);
  ResultInfo info;
  info.path = path;
  read_attributes(file, info);
  read_axes(file, info);
  read_partitions(file, info);
  info.safe_cells = file.natural("/safe", "cells");
  info.invariant_cells = file.natural("/invariant", "cells");
  info.connection_delay = file.integer("/trigger", "connection_delay");
  if (file.exists(paths::kCoalition)) info.coalition = read_coalition(file, info.partitions.size());
  read_modes(file, info);
  info.requirements = read_stored_requirements(file, names_of(info.states), names_of(info.inputs));
  info.datasets = file.datasets();
  if (file.exists(paths::kListed)) info.controller_sha256 = file.text(paths::kListed, "sha256");
  return info;
}

}  // namespace

ResultInfo read_info(const std::string& path) {
  try_in_child(path, [&] { static_cast<void>(reading(path, [&] { return read(path); })); });
  return reading(path, [&] { return read(path); });
}

}  // namespace coordreq
