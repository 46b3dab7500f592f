#include "results/controller_file.hpp"

#include <fmt/format.h>

#include "answers/paths.hpp"
#include "base/error.hpp"
#include "results/child_trial.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Shape = std::vector<std::uint64_t>;

class StoredController {
 public:
  StoredController(const std::string& path, const ProblemSpec& spec)
      : file_(path), spec_(spec), path_(path) {}

  void check() {
    if (!file_.exists(paths::kController)) {
      throw ResultsError(
          "holds no /controller: expected results of a spec with \"output\": {\"controller\": true}", path_);
    }
    check_axes();
    check_inputs();
    for (const StateSpec& state : spec_.states) check_points(state.name, grid_points(state.grid));
    for (const InputSpec& input : spec_.inputs) check_points(input.name, input.values);
    check_bytes();
  }

  PackedPairs read() {
    PackedPairs pairs{.inputs = inputs_, .bytes = {}};
    std::uint64_t size = 1;
    for (const std::uint64_t length : shape_) size *= length;
    pairs.bytes.resize(size);
    file_.read_block(paths::kController, ElementType::uint8, Shape(shape_.size(), 0), shape_,
                     pairs.bytes.data());
    check_padding(pairs);
    return pairs;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& object) const {
    throw ResultsError(what, file_.location(object));
  }

  static std::vector<Rational> grid_points(const GridSpec& grid) {
    std::vector<Rational> points;
    for (std::int64_t k = 0; k < grid.count; ++k) points.push_back(grid.point(k));
    return points;
  }

  /// The states in the order of the spec; else its cells would be taken for others.
  void check_axes() const {
    std::string expected;
    for (const StateSpec& state : spec_.states) expected += (expected.empty() ? "" : " ") + state.name;
    std::vector<std::string> axes = file_.axes(paths::kController);
    if (!axes.empty()) axes.pop_back();  // bytes
    const std::string found = fmt::format("{}", fmt::join(axes, " "));
    if (found != expected)
      fail(fmt::format("the axes are the states '{}', expected '{}'", found, expected), paths::kController);
  }

  void check_inputs() const {
    std::string expected;
    for (const InputSpec& input : spec_.inputs) expected += (expected.empty() ? "" : " ") + input.name;
    const std::string found = file_.text(paths::kController, "inputs");
    if (found != expected) {
      fail(fmt::format("the attribute inputs is '{}', expected '{}'", found, expected), paths::kController);
    }
    if (file_.text(paths::kController, "bitorder") != "little")
      fail("the attribute bitorder is not 'little'", paths::kController);
  }

  void check_points(const std::string& name, const std::vector<Rational>& expected) const {
    const std::string path = "/" + name;
    const Shape shape = file_.shape(path);
    if (shape.size() != 1 || shape.front() != expected.size()) {
      fail(fmt::format("found {} grid points, expected {}", fmt::join(shape, " x "), expected.size()), path);
    }
    // Other programs write whole numbers where grid points are.
    file_.expect_array(path,
                       {ElementType::float64, ElementType::float32, ElementType::int64, ElementType::int32,
                        ElementType::int16, ElementType::uint64, ElementType::uint32, ElementType::uint8},
                       shape);
    const std::vector<double> found = file_.numbers(path);
    const std::optional<double> distance = spacing(expected);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double point = nearest_double(expected[k]);
      if (same_point(found[k], point, distance)) continue;
      fail(fmt::format("grid point {} is {}, expected {}", k, found[k], point), path);
    }
  }

  void check_bytes() {
    inputs_ = 1;
    for (const InputSpec& input : spec_.inputs) inputs_ *= static_cast<std::int64_t>(input.values.size());
    for (const StateSpec& state : spec_.states)
      shape_.push_back(static_cast<std::uint64_t>(state.grid.count));
    shape_.push_back(static_cast<std::uint64_t>(PackedPairs::bytes_for(inputs_)));
    file_.expect_array(paths::kController, {ElementType::uint8}, shape_);
    const std::int64_t actions = file_.integer(paths::kController, "actions");
    if (actions != inputs_)
      fail(fmt::format("the attribute actions is {}, expected {}", actions, inputs_), paths::kController);
  }

  /// A bit beyond the last joint input is no input: the numbering is another one.
  void check_padding(const PackedPairs& pairs) const {
    if (inputs_ % 8 == 0) return;
    const auto length = static_cast<std::size_t>(pairs.bytes_per_cell());
    for (std::size_t last = length - 1; last < pairs.bytes.size(); last += length) {
      if (pairs.bytes[last] >> (inputs_ % 8) == 0) continue;
      fail(fmt::format("cell {} has a bit set beyond its {} joint inputs", last / length, inputs_),
           paths::kController);
    }
  }

  ResultsFile file_;
  const ProblemSpec& spec_;
  std::string path_;
  Shape shape_;
  std::int64_t inputs_ = 0;
};

}  // namespace

void check_stored_controller(const std::string& path, const ProblemSpec& spec) {
  try_in_child(path, [&] { reading(path, [&] { StoredController(path, spec).check(); }); });
}

PackedPairs read_stored_controller(const std::string& path, const ProblemSpec& spec) {
  check_stored_controller(path, spec);
  return reading(path, [&] {
    StoredController stored(path, spec);
    stored.check();
    return stored.read();
  });
}

}  // namespace coordreq
