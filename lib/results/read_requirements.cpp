#include "results/read_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "results/requirement_sections.hpp"
#include "results/results_paths.hpp"

namespace coordreq {
namespace {

using Numbers = std::vector<std::int64_t>;

class RequirementReader {
 public:
  RequirementReader(const ResultsFile& file, const std::vector<std::string>& states,
                    const std::vector<std::string>& inputs)
      : file_(file), states_(states.size()), inputs_(inputs.size()) {
    expect_names("state_name", states);
    expect_names("input_name", inputs);
  }

  std::vector<ResultRequirement> read() {
    const std::vector<std::string> names = file_.texts(at("requirement"));
    count_ = names.size();
    const auto sides = static_cast<std::int64_t>(2 * states_);
    const Numbers holds = of_each("holds", 0, 1);
    const Numbers cells = of_each("cells", 0, kMost);
    const Numbers failing = of_each("failing", 0, kMost);
    const Numbers delays = of_each("least_delay", -2, kMost);
    const Numbers reached = of_each("reached_side", 0, sides);
    const Numbers ends = of_each("end", 0, 4);
    const Numbers left = of_each("left_side", 0, sides);
    std::vector<ResultRequirement> result;
    for (std::size_t r = 0; r < count_; ++r) {
      ResultRequirement& requirement =
          result.emplace_back(ResultRequirement{.name = names[r],
                                                .holds = holds[r] != 0,
                                                .cells = static_cast<std::uint64_t>(cells[r]),
                                                .failing = static_cast<std::uint64_t>(failing[r]),
                                                .least_delay = static_cast<std::int32_t>(delays[r]),
                                                .reached_side = side_of_number(reached[r])});
      if (ends[r] == 0 && left[r] != 0)
        throw ResultsError("a side without a counterexample", file_.place(at("left_side")));
      if (ends[r] == 0) continue;
      requirement.path = read_path(paths::counterexample(r));
      requirement.path->end = static_cast<EscapeEnd>(ends[r] - 1);
      requirement.path->left_side = side_of_number(left[r]);
    }
    return result;
  }

 private:
  static constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

  static std::string at(const std::string& name) { return fmt::format("{}/{}", paths::kRequirements, name); }

  Numbers list(const std::string& path, std::size_t length, std::int64_t least, std::int64_t most) const {
    file_.expect_shape(path, {length});
    Numbers values = file_.integers(path);
    for (const std::int64_t value : values) {
      if (value >= least && value <= most) continue;
      throw ResultsError("found " + std::to_string(value) + ", which is none of its values",
                         file_.place(path));
    }
    return values;
  }
  Numbers of_each(const std::string& name, std::int64_t least, std::int64_t most) const {
    return list(at(name), count_, least, most);
  }

  std::vector<double> table(const std::string& path, std::size_t rows, std::size_t columns) const {
    file_.expect_shape(path, {rows, columns});
    return file_.numbers(path);
  }

  void expect_names(const std::string& name, const std::vector<std::string>& expected) const {
    if (file_.texts(at(name)) != expected)
      throw ResultsError("the names are not those of the spec", file_.place(at(name)));
  }

  /// The length of a list of the numbers 0, 1, ...
  [[nodiscard]] std::size_t count_of(const std::string& path) const {
    const Numbers numbers = file_.integers(path);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (numbers[k] != static_cast<std::int64_t>(k))
        throw ResultsError("not the numbers 0, 1, ...", file_.place(path));
    }
    if (file_.shape(path).size() != 1 || numbers.empty()) throw ResultsError("not a list", file_.place(path));
    return numbers.size();
  }

  ResultPath read_path(const std::string& group) const {
    const std::size_t samples = count_of(group + "/sample");
    const std::size_t steps = file_.exists(group + "/step") ? count_of(group + "/step") : 0;
    if (steps != samples && steps + 1 != samples) {
      throw ResultsError(
          "found " + std::to_string(steps) + " steps between " + std::to_string(samples) + " samples",
          file_.place(group));
    }
    const auto narrow = [](const Numbers& values) {
      return std::vector<std::int32_t>(values.begin(), values.end());
    };
    constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
    const Numbers cells = list(group + "/cell", samples, 0, kMost);
    ResultPath path{.cell = {cells.begin(), cells.end()},
                    .state = table(group + "/state", samples, states_),
                    .delay = narrow(list(group + "/delay", samples, -2, kLargest)),
                    .collision_time = narrow(list(group + "/collision_time", samples, 0, kLargest))};
    if (steps == 0) return path;
    path.input = table(group + "/input", steps, inputs_);
    for (const std::int64_t phase : list(group + "/phase", steps, 0, 1))
      path.phase.push_back(static_cast<EscapePhase>(phase));
    return path;
  }

  const ResultsFile& file_;
  std::size_t states_;
  std::size_t inputs_;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<ResultRequirement> read_stored_requirements(const ResultsFile& file,
                                                        const std::vector<std::string>& states,
                                                        const std::vector<std::string>& inputs) {
  if (!file.exists(paths::kRequirements)) return {};
  return RequirementReader(file, states, inputs).read();
}

}  // namespace coordreq
