#include "analysis/analyze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "analysis/advice.hpp"
#include "analysis/analysis_stages.hpp"
#include "analysis/checkpoint.hpp"
#include "analysis/estimate_memory.hpp"
#include "analysis/motion.hpp"
#include "analysis/stage_reporter.hpp"
#include "analysis/tightness.hpp"
#include "answers/field_table.hpp"
#include "answers/plan.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "reach/build_abstraction.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void open_checkpoint(const ProblemSpec& spec, const AnalysisOptions& options, StageReporter& reporter,
                     std::optional<Checkpoint>& checkpoint) {
  if (!options.checkpoint) return;
  const Checkpoint::Listener listener{
      .progress = [&reporter](bool has_temporary) { reporter.set_temporary(has_temporary); },
      .notice =
          [&options](const std::string& text) {
            if (options.notice) options.notice(text);
          }};
  reporter.enter("checkpoint");
  checkpoint.emplace(*options.checkpoint, spec, listener, options.ranks);
}

/// Memory that one of several processes may use, and that it has used before any work.
struct RankMemory {
  std::optional<std::uint64_t> limit;
  bool saves = false;  ///< a checkpoint
  double before = memory_of_program() + (saves ? kCheckpointBytes : 0);
};

/// Compares the memory of each rank with its limit; called once the rows are divided. Together.
/// @throws LimitError
void check_rank_memory(const AnalysisContext& context, const RankMemory& memory, int threads) {
  if (!memory.limit || !context.share) return;
  std::int64_t held = 0;
  for (const RowShare::Range run : context.share->held()) held += run.end - run.begin;
  const auto rows = static_cast<double>(context.abstraction->grid.rows());
  const RowShare::Range local_rows = context.share->local();
  const RowFractions fractions{.held = static_cast<double>(held) / rows,
                               .local = static_cast<double>(local_rows.end - local_rows.begin) / rows,
                               .slices = bytes_of_slices(*context.engine)};
  const double needed = estimate_memory_of_rank(context.model, threads, memory.before, fractions);
  const std::int64_t most = context.ranks->greatest(static_cast<std::int64_t>(std::min(needed, 9e18)));
  check_memory_limit(context.spec, static_cast<double>(most), static_cast<double>(*memory.limit),
                     fmt::format("on the fullest of {} ranks, ", context.ranks->count()));
}

/// Bytes that all processes have exchanged, by stage.
class ExchangeMeter {
 public:
  explicit ExchangeMeter(Ranks* ranks) : ranks_(ranks) {}

  void enter(const std::string& stage) {
    end();
    stage_ = stage;
  }
  /// Adds them to what fixed points took. Together.
  void describe(Json& work) {
    if (ranks_ == nullptr) return;
    end();
    std::vector<std::int64_t> bytes;
    for (const auto& [stage, sent] : stages_) bytes.push_back(sent);
    ranks_->add(bytes);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (work.contains(stages_[i].first)) work[stages_[i].first]["exchanged_bytes"] = bytes[i];
    }
  }

 private:
  void end() {
    if (ranks_ == nullptr) return;
    const std::int64_t sent = ranks_->sent_bytes();
    if (!stage_.empty()) stages_.emplace_back(stage_, sent - before_);
    before_ = sent;
    stage_.clear();
  }

  Ranks* ranks_;
  std::string stage_;
  std::int64_t before_ = 0;
  std::vector<std::pair<std::string, std::int64_t>> stages_;
};

void find_answers(Answers& answers, StageReporter& reporter, Checkpoint* checkpoint, const RankMemory& memory,
                  ExchangeMeter& meter, ThreadTeam& team) {
  const StageWork work{
      .team = team,
      .substage = [&reporter](const std::string& substage) { reporter.enter_substage(substage); },
      .step = [&reporter](const WaveStep& step,
                          std::int64_t row_length) { reporter.step(step, row_length); }};
  bool is_checked = false;
  const PlanWatch watch{.enter =
                            [&](const std::string& stage) {
                              reporter.enter(stage);
                              meter.enter(stage);
                              if (is_checked || !answers.context.engine) return;
                              check_rank_memory(answers.context, memory, team.size());
                              is_checked = true;
                            },
                        .store = [checkpoint](const std::string& stage) -> StageStore* {
                          return checkpoint == nullptr ? nullptr : checkpoint->enter(stage);
                        }};
  run_stages(analysis_stages(answers.context.spec), answers, work, watch);
}

void write(const std::string& path, const Answers& answers, StageReporter& reporter, ThreadTeam& team) {
  reporter.enter("writing");
  reporter.enter_substage("lists");
  FieldValues values = computed_values(answers, team);
  reporter.watch_writing(answers.context.spec, values);
  reporter.set_temporary(true);
  std::optional<RankChunks> ranks;
  if (answers.context.share) ranks.emplace(team, *answers.context.share, *answers.context.order);
  write_results(path, answers.context.spec, values, team, ranks ? &*ranks : nullptr);
  reporter.set_written();
}

/// The members of all answers. @param work takes the counts of fixed points
Json summarise(const Answers& answers, Json& work) {
  Json summary;
  for (const Answer& answer : all_answers()) answer.summarise(answers, summary, work);
  return summary;
}

}  // namespace

Json analyze(const Model& model, const AnalysisOptions& options, ThreadTeam& team) {
  Ranks* const ranks = options.ranks != nullptr && options.ranks->count() > 1 ? options.ranks : nullptr;
  const bool is_first = ranks == nullptr || ranks->rank() == 0;
  if (!options.output.empty() && is_first) check_writable(options.output);
  if (options.checkpoint && is_first) check_checkpoint(*options.checkpoint, options.ranks != nullptr);
  const RankMemory memory{.limit = ranks == nullptr ? std::nullopt : options.max_memory,
                          .saves = options.checkpoint.has_value()};
  StageReporter reporter(options.progress, team);
  std::optional<Checkpoint> checkpoint;
  open_checkpoint(model.spec(), options, reporter, checkpoint);
  Answers answers(model, ranks);
  ExchangeMeter meter(ranks);
  find_answers(answers, reporter, checkpoint ? &*checkpoint : nullptr, memory, meter, team);
  Json work = Json::object();
  Json summary = summarise(answers, work);
  meter.describe(work);
  const std::optional<Tightness> tightness = find_tightness(answers.context);
  if (tightness) {
    work["helpers"]["tightness"] = {{"posts", tightness->posts.size()}, {"left_out", tightness->left_out}};
  }
  summary["tightness"] = tightness_json(tightness);
  const Motion motion = sample_motion(model.spec());
  summary["motion"] = motion_json(model.spec(), motion.states);
  work["helpers"]["motion"] = {{"solutions", motion.solutions}, {"left_out", motion.left_out}};
  if (!options.output.empty()) write(options.output, answers, reporter, team);
  if (checkpoint) checkpoint->remove();
  summary["output"] = options.output.empty() ? Json() : Json(options.output);
  summary["threads"] = team.size();
  summary["seconds"] = Json::object();
  for (const auto& [stage, seconds] : reporter.finish()) summary["seconds"][stage] = seconds;
  const auto peak = static_cast<std::int64_t>(peak_memory_bytes());
  summary["peak_memory_bytes"] = ranks == nullptr ? peak : ranks->greatest(peak);
  Warnings warnings = is_first ? advise(answers, motion.states, team, work) : Warnings();
  if (is_first) {
    for (Warning& more : advise_on_tightness(model.spec(), tightness)) warnings.push_back(std::move(more));
  }
  // What is not the answer itself comes last.
  Json helpers = std::move(work["helpers"]);
  work.erase("helpers");
  work["helpers"] = std::move(helpers);
  summary["work"] = std::move(work);
  summary["warnings"] = warnings_json(warnings);
  return summary;
}

Json analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team) {
  return analyze(make_model(spec), options, team);
}

}  // namespace coordreq
