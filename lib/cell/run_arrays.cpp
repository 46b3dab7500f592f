#include "cell/run_arrays.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace coordreq {
namespace {

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

template <class Element, class Value>
ResultArray per_run(ElementType type, const Simulation& simulation, const Value& value) {
  return per_sample<Element>(
      type, simulation, 1, 1,
      [value](const RunTrace& trace, std::size_t, std::size_t) { return value(trace); });
}

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// A member of the samples, with a filler where a run has ended.
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

bool is_measured_wrongly(const ProblemSpec& spec) {
  return std::any_of(spec.states.begin(), spec.states.end(),
                     [](const StateSpec& state) { return state.measurement_error != 0; });
}

void add_names(const ProblemSpec& spec, RunContent& content) {
  for (const StateSpec& state : spec.states) content.states.push_back({state.name, state.unit});
  for (const InputSpec& input : spec.inputs) content.inputs.push_back({input.name, input.unit});
  for (const DisturbanceSpec& w : spec.disturbances) content.disturbances.push_back({w.name, w.unit});
}

void add_vectors(const ProblemSpec& spec, const InputSpace& inputs, const Simulation& simulation,
                 RunContent& content) {
  using Sample = RunTrace::Sample;
  using Step = RunTrace::Step;
  const auto array = [&](std::size_t width, const auto& value) {
    return per_sample<double>(ElementType::float64, simulation, content.time.size(), width, value);
  };
  content.state = array(spec.states.size(),
                        of_sample(kNothing, [](const Sample& s, std::size_t j) { return s.state[j]; }));
  if (is_measured_wrongly(spec)) {
    content.measured =
        array(spec.states.size(),
              of_sample(kNothing, [](const Sample& s, std::size_t j) { return s.measured[j]; }));
  }
  content.input = array(spec.inputs.size(), of_step(kNothing, [&inputs](const Step& step, std::size_t j) {
                          const std::int64_t k = inputs.index(step.input, j);
                          return nearest_double(inputs[j].values[static_cast<std::size_t>(k)]);
                        }));
  if (!spec.disturbances.empty()) {
    content.disturbance =
        array(spec.disturbances.size(),
              of_step(kNothing, [](const Step& s, std::size_t j) { return s.disturbance[j]; }));
  }
  content.margin = array(1, of_sample(kNothing, [](const Sample& s, std::size_t) { return s.margin; }));
}

void add_coordination(const Simulation& simulation, RunContent& content) {
  using Sample = RunTrace::Sample;
  constexpr std::int32_t kNone = RunContent::kNoSample;
  const std::uint64_t samples = content.time.size();
  content.countdown =
      per_sample<std::int32_t>(ElementType::int32, simulation, samples, 1,
                               of_sample(kNone, [](const Sample& s, std::size_t) { return s.countdown; }));
  content.delay =
      per_sample<std::int32_t>(ElementType::int32, simulation, samples, 1,
                               of_sample(kNone, [](const Sample& s, std::size_t) { return s.delay; }));
  content.coordinated = per_sample<std::uint8_t>(
      ElementType::uint8, simulation, samples, 1,
      of_step(RunContent::kNoStep, [](const RunTrace::Step& step, std::size_t) -> std::uint8_t {
        return step.coordinated ? 1 : 0;
      }));
  content.samples = per_run<std::int32_t>(ElementType::int32, simulation, [](const RunTrace& trace) {
    return static_cast<std::int32_t>(trace.samples.size());
  });
  content.outcome = per_run<std::uint8_t>(ElementType::uint8, simulation, [](const RunTrace& trace) {
    return static_cast<std::uint8_t>(trace.outcome);
  });
  for (const Outcome outcome :
       {Outcome::completed, Outcome::left_safely, Outcome::left_invariant, Outcome::no_action}) {
    content.outcome_names.push_back(outcome_name(outcome));
  }
}

}  // namespace

RunContent run_content(const ResultsReader& results, const InputSpace& inputs,
                       const SimulationOptions& options, const Simulation& simulation) {
  const ProblemSpec& spec = results.spec();
  RunContent content{.name = spec.name,
                     .spec_text = spec.text,
                     .guarantee = results.attributes().guarantee,
                     .period = nearest_double(spec.dynamics.period),
                     .period_unit = spec.dynamics.unit,
                     .partition = simulation.partition,
                     .connection_delay = spec.coordination.connection_delay,
                     .policy = policy_name(options.policy),
                     .disturbance_policy = disturbance_name(options.disturbance),
                     .seed = options.seed,
                     .runs = static_cast<std::uint64_t>(options.runs)};
  for (std::int64_t k = 0; k <= options.steps; ++k) {
    content.time.push_back(nearest_double(spec.dynamics.period * Rational(static_cast<long>(k))));
  }
  add_names(spec, content);
  add_vectors(spec, inputs, simulation, content);
  add_coordination(simulation, content);
  return content;
}

}  // namespace coordreq
