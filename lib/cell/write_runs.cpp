#include "cell/write_runs.hpp"

#include <algorithm>
#include <limits>

#include "answers/field_parts.hpp"
#include "answers/plan.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"
#include "spec/units.hpp"

namespace coordreq {
namespace {

using Sample = RunTrace::Sample;
using Step = RunTrace::Step;

// Where a run has ended.
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::int32_t kNoSample = -4;
constexpr std::uint8_t kNoStep = 255;

/// An array [runs, samples, width] whose elements are looked up one by one: value(trace, k, j).
template <class Element, class Value>
ResultArray per_sample(ElementType type, const Simulation& simulation, std::uint64_t samples,
                       std::uint64_t width, const Value& value) {
  return {type, [&simulation, samples, width, value](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* elements = static_cast<Element*>(out);
            for (std::uint64_t i = begin; i < begin + count; ++i) {
              const std::uint64_t sample = i / width;
              elements[i - begin] = value(simulation.traces[sample / samples], sample % samples, i % width);
            }
          }};
}

/// A member of the samples, with a filler where a run has ended; likewise of the steps.
template <class Element, class Member>
auto of_sample(Element filler, const Member& member) {
  return [filler, member](const RunTrace& trace, std::size_t k, std::size_t j) -> Element {
    return k < trace.samples.size() ? member(trace.samples[k], j) : filler;
  };
}

template <class Element, class Member>
auto of_step(Element filler, const Member& member) {
  return [filler, member](const RunTrace& trace, std::size_t k, std::size_t j) -> Element {
    return k < trace.steps.size() ? member(trace.steps[k], j) : filler;
  };
}

/// Units stand in the long name, since CF has one unit a dataset.
template <class Variable>
std::string component_text(const std::string& kind, const std::vector<Variable>& variables) {
  std::string text;
  for (const Variable& variable : variables)
    text += (text.empty() ? "" : ", ") + variable.name + " [" + udunits_spelling(variable.unit) + "]";
  return kind + ": " + text;
}

/// The fields of a file of runs, with their values, one after the other.
class RunFields {
 public:
  RunFields(const ResultsReader& results, const SimulationOptions& options, const Simulation& simulation)
      : results_(results),
        spec_(results.spec()),
        inputs_(results.inputs()),
        policies_(answer_policies(results.spec())),
        simulation_(simulation) {
    runs_ = static_cast<std::uint64_t>(options.runs);
    samples_ = static_cast<std::uint64_t>(options.steps) + 1;
    add_axes();
    add_vectors();
    add_coordination();
    add_ends();
  }

  Fields fields;
  FieldValues values;

 private:
  static constexpr FieldSection kSection = FieldSection::maps;  // fields are in their order already

  void add_axes() {
    fields.push_back(number_scale("/run", kSection, runs_, runs_, "number of the run"));
    const auto time = [period = spec_.dynamics.period](std::uint64_t k) {
      return nearest_double(period * Rational(static_cast<long>(k)));
    };
    fields.push_back(
        {.path = "/time",
         .section = kSection,
         .types = {ElementType::float64},
         .axes = {},
         .scale = FieldScale{.coordinates = GridPoints{time}, .least = samples_, .most = samples_},
         .attributes = {{"long_name", std::string("time of the sample")},
                        {"units", udunits_spelling(spec_.dynamics.unit)}}});
    add_names(spec_.states, "state");
    add_names(spec_.inputs, "input");
    if (!spec_.disturbances.empty()) add_names(spec_.disturbances, "disturbance");
  }

  template <class Variable>
  void add_names(const std::vector<Variable>& variables, const std::string& kind) {
    std::vector<std::string> names;
    for (const Variable& variable : variables) names.push_back(variable.name);
    fields.push_back(name_scale("/" + kind + "_name", kSection, std::move(names), "name of the " + kind));
  }

  void add(const std::string& path, std::vector<std::string> axes, std::vector<FieldAttribute> attributes,
           ResultArray array) {
    fields.push_back({.path = path,
                      .section = kSection,
                      .types = {array.type},
                      .axes = std::move(axes),
                      .attributes = std::move(attributes)});
    values.entries[path].array = std::move(array);
  }

  template <class Value>
  void add_vector(const std::string& path, const std::string& names, std::size_t width, std::string long_name,
                  const Value& value) {
    add(path, {"/run", "/time", names}, {{"long_name", std::move(long_name)}},
        per_sample<double>(ElementType::float64, simulation_, samples_, width, value));
  }

  void add_vectors() {
    add_vector("/state", "/state_name", spec_.states.size(), component_text("true state", spec_.states),
               of_sample(kNothing, [](const Sample& s, std::size_t j) { return s.state[j]; }));
    if (std::any_of(spec_.states.begin(), spec_.states.end(),
                    [](const StateSpec& state) { return state.measurement_error != 0; })) {
      add_vector("/measured", "/state_name", spec_.states.size(),
                 component_text("measured state", spec_.states),
                 of_sample(kNothing, [](const Sample& s, std::size_t j) { return s.measured[j]; }));
    }
    add_vector("/input", "/input_name", spec_.inputs.size(),
               component_text("input from the sample on", spec_.inputs),
               of_step(kNothing, [&inputs = inputs_](const Step& step, std::size_t j) {
                 const std::int64_t k = inputs.index(step.input, j);
                 return nearest_double(inputs[j].values[static_cast<std::size_t>(k)]);
               }));
    if (spec_.disturbances.empty()) return;
    add_vector("/disturbance", "/disturbance_name", spec_.disturbances.size(),
               component_text("disturbance from the sample on", spec_.disturbances),
               of_step(kNothing, [](const Step& s, std::size_t j) { return s.disturbance[j]; }));
  }

  /// A number a sample.
  template <class Element, class Value>
  void add_list(const std::string& path, ElementType type, std::vector<FieldAttribute> attributes,
                const Value& value) {
    add(path, {"/run", "/time"}, std::move(attributes),
        per_sample<Element>(type, simulation_, samples_, 1, value));
  }

  void add_coordination() {
    const FieldFlag no_sample{kNoSample, "no_sample"};
    add_list<std::int32_t>("/countdown", ElementType::int32,
                           described("steps that the agents still act without coordination") +
                               std::vector<FieldAttribute>{flags({no_sample, {kLargestValue, "never"}})},
                           of_sample(kNoSample, [](const Sample& s, std::size_t) { return s.countdown; }));
    add_list<std::int32_t>(
        "/delay", ElementType::int32,
        described("delay of the cell: steps without coordination that keep the system safe") +
            std::vector<FieldAttribute>{
                flags({no_sample, {-2, "not_safe"}, {-1, "not_invariant"}, {kLargestValue, "unbounded"}})},
        of_sample(kNoSample, [](const Sample& s, std::size_t) { return s.delay; }));
    for (const AnswerPolicy& policy : policies_) {
      if (!policy.aim.path.empty()) add_aim(policy.aim, no_sample);
    }
    add_list<std::uint8_t>(
        "/coordinated", ElementType::uint8,
        described("the agents coordinate the step that follows the sample") +
            std::vector<FieldAttribute>{flags({{0, "alone"}, {1, "coordinated"}, {kNoStep, "no_step"}})},
        of_step(kNoStep, [](const Step& s, std::size_t) -> std::uint8_t { return s.coordinated ? 1 : 0; }));
    // In the units of what `safe` compares, which may be several.
    add_list<double>("/margin", ElementType::float64,
                     {{"long_name", std::string("quantitative semantics of safe at the true state")}},
                     of_sample(kNothing, [](const Sample& s, std::size_t) { return s.margin; }));
  }

  /// Steps to the aim of a policy.
  void add_aim(const AnswerPolicy::Aim& aim, const FieldFlag& no_sample) {
    std::vector<FieldFlag> meanings = flags_of(results_.field(aim.path));
    meanings.insert(meanings.begin(), no_sample);
    add_list<std::int32_t>(aim.path, ElementType::int32,
                           described(aim.path.substr(1) + " of the cell: " + aim.label) +
                               std::vector<FieldAttribute>{flags(std::move(meanings))},
                           of_sample(kNoSample, [](const Sample& s, std::size_t) { return s.arrival; }));
  }

  template <class Element, class Value>
  void add_end(const std::string& path, ElementType type, std::vector<FieldAttribute> attributes,
               const Value& value) {
    add(path, {"/run"}, std::move(attributes),
        per_sample<Element>(type, simulation_, 1, 1,
                            [value](const RunTrace& trace, std::size_t, std::size_t) {
                              return static_cast<Element>(value(trace));
                            }));
  }

  void add_ends() {
    if (spec_.goal) {
      add_end<std::int32_t>("/arrived", ElementType::int32,
                            described("sample at which the goal is reached") +
                                std::vector<FieldAttribute>{flags({{-1, "not_reached"}})},
                            [](const RunTrace& trace) { return trace.arrived.value_or(-1); });
    }
    add_end<std::int32_t>("/samples", ElementType::int32, described("number of samples of the run"),
                          [](const RunTrace& trace) { return trace.samples.size(); });
    std::vector<FieldFlag> outcomes;
    for (const Outcome outcome : coordreq::outcomes(spec_))
      outcomes.push_back({static_cast<std::int64_t>(outcome), outcome_name(outcome)});
    add_end<std::uint8_t>(
        "/outcome", ElementType::uint8,
        described("how the run ended") + std::vector<FieldAttribute>{flags(std::move(outcomes))},
        [](const RunTrace& trace) { return trace.outcome; });
  }

  const ResultsReader& results_;
  const ProblemSpec& spec_;
  const InputSpace& inputs_;
  std::vector<AnswerPolicy> policies_;
  const Simulation& simulation_;
  std::uint64_t runs_ = 0, samples_ = 0;
};

}  // namespace

void write_runs(const std::string& path, const ResultsReader& results, const SimulationOptions& options,
                const Simulation& simulation, ThreadTeam& team) {
  const ProblemSpec& spec = results.spec();
  std::vector<FieldAttribute> attributes = {{"partition", simulation.partition},
                                            {"connection_delay", spec.coordination.connection_delay},
                                            {"policy", policy_name(options.policy)},
                                            {"disturbance_policy", disturbance_name(options.disturbance)},
                                            {"seed", options.seed}};
  if (options.kind != nullptr) {
    const CountdownOption& option = options.kind->option;
    attributes.push_back({option.key(), option.takes_steps ? options.silent_steps.value_or(-1) : 1});
  }
  const RunFields runs(results, options, simulation);
  write_fields(path, {.label = "the runs", .filetype = "coordreq-runs", .version = {1, 0}},
               header_attributes(spec) + attributes, spec, runs.fields, runs.values, team);
}

}  // namespace coordreq
