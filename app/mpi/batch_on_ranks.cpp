#include "app/mpi/on_ranks.hpp"

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "app/interrupt.hpp"
#include "base/json.hpp"
#include "spec/read_spec.hpp"
#include "spec/spec_location.hpp"

namespace coordreq {
namespace {

constexpr std::chrono::milliseconds kPause{1};

Bytes message_of(const Json& json) {
  return bytes_of(compact_json(json));
}

Json json_of(const Bytes& message) {
  return parse_json(text_of(message));
}

Json request_of(const PlannedRun& run) {
  return {{"text", run.spec->text},
          {"is_written", !run.spec->written},
          {"path", run.path},
          {"folder", run.spec->folder},
          {"output", run.output}};
}

Json answer_of(const RunOutcome& outcome) {
  Json answer{{"exit_code", outcome.exit_code}};
  if (outcome.summary) answer["summary"] = *outcome.summary;
  if (outcome.failure) answer["failure"] = {{"what", outcome.failure->what}, {"more", outcome.failure->more}};
  return answer;
}

RunOutcome outcome_from(const Json& answer) {
  RunOutcome outcome{.exit_code = answer["exit_code"].get<int>()};
  if (answer.contains("summary")) outcome.summary = std::make_shared<const Json>(answer["summary"]);
  if (answer.contains("failure"))
    outcome.failure = Failure{answer["failure"]["what"], outcome.exit_code, answer["failure"]["more"]};
  return outcome;
}

/// Does what the first rank asks for, until that is nothing.
void serve(const AnalyzeOptions& args, Ranks& ranks) {
  for (;;) {
    const Bytes message = ranks.receive(0);
    if (message.empty()) return;
    const Json request = json_of(message);
    ProblemSpec spec =
        read_spec({.text = request["text"], .name = request["path"], .folder = request["folder"]});
    if (!request["is_written"].get<bool>()) spec.written = std::make_shared<WrittenSpec>();
    ranks.send(0, message_of(answer_of(outcome_of(spec, request["output"], args, ""))));
  }
}

/// Hands out the runs.
class Dispatcher {
 public:
  Dispatcher(const std::vector<PlannedRun>& plan, Ranks& ranks,
             const std::function<void(std::size_t, RunOutcome)>& done)
      : plan_(plan), ranks_(ranks), done_(done), runs_of_(static_cast<std::size_t>(ranks.count())) {}

  void run(AnalyzeOptions args) {
    args.watch = [this] { look(); };
    for (int rank = 1; rank < ranks_.count(); ++rank) give(rank);
    while (const std::optional<std::size_t> run = take())
      done_(*run, outcome_of(*plan_[*run].spec, plan_[*run].output, args, ""));
    while (at_work_ > 0) {
      if (is_interrupted()) throw interruption();
      look();
      std::this_thread::sleep_for(kPause);
    }
  }

 private:
  /// The next run.
  std::optional<std::size_t> take() {
    while (next_ < plan_.size() && !plan_[next_].spec) ++next_;
    return next_ < plan_.size() ? std::optional(next_++) : std::nullopt;
  }

  /// @param rank that has nothing to do
  void give(int rank) {
    std::optional<std::size_t>& run = runs_of_[static_cast<std::size_t>(rank)];
    run = take();
    ranks_.send(rank, run ? message_of(request_of(plan_[*run])) : Bytes());
    at_work_ += run ? 1 : 0;
  }

  /// Whether anybody has done his.
  void look() {
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      const std::optional<std::size_t> run = runs_of_[static_cast<std::size_t>(rank)];
      if (!run || !ranks_.has_message(rank)) continue;
      --at_work_;
      RunOutcome outcome = outcome_from(json_of(ranks_.receive(rank)));
      give(rank);
      done_(*run, std::move(outcome));
    }
  }

  const std::vector<PlannedRun>& plan_;
  Ranks& ranks_;
  const std::function<void(std::size_t, RunOutcome)>& done_;
  std::vector<std::optional<std::size_t>> runs_of_;  ///< [rank] what it does
  std::size_t next_ = 0;
  int at_work_ = 0;
};

}  // namespace

ExitCode run_batch_on_ranks(const AnalyzeOptions& args) {
  Ranks& ranks = *args.ranks;
  AnalyzeOptions alone = args;
  alone.ranks = nullptr;
  if (ranks.rank() != 0) {
    serve(alone, ranks);
    return ExitCode::success;
  }
  // A bar would clash with the lines that others print.
  if (alone.progress.mode != ProgressMode::log) alone.progress.mode = ProgressMode::none;
  return run_analyze_batch(alone, [&ranks](const std::vector<PlannedRun>& plan, const AnalyzeOptions& options,
                                           const std::function<void(std::size_t, RunOutcome)>& done) {
    Dispatcher(plan, ranks, done).run(options);
  });
}

}  // namespace coordreq
