#include "answers/context/answer.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "answers/row_cut.hpp"
#include "engine/join_rows.hpp"
#include "model/model.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The abstraction in the order of the model, with rows along several dimensions where they can run so and no
/// answer of the spec needs rows along one.
Abstraction in_order(const Model& model, Abstraction abstraction) {
  abstraction = arranged(std::move(abstraction), model.order());
  abstraction.grid = join_rows(abstraction, model.most_along());
  return abstraction;
}

/// The entries of tables by cells that this process has. Together: cuts the rows if they are cut before there
/// are tables.
HeldCells held_cells(AnalysisContext& context) {
  const Model& model = context.model;
  if (context.ranks == nullptr || !is_cut_before_tables(model))
    return {.order = model.order(), .begin = 0, .end = model.grid().points()};
  context.share.emplace(*context.ranks, cut_into_shares(model, nullptr, context.ranks->count()));
  const RowShare::Range rows = context.share->local();
  const std::int64_t row = model.grid().row_length();
  return {.order = model.order(), .begin = rows.begin * row, .end = rows.end * row};
}

/// Finds the abstraction, or takes the kept one, which is in the order of the spec but for tables by cells.
void find_abstraction(AnalysisContext& context, const StageWork& work) {
  const ProblemSpec& spec = context.spec;
  std::optional<Abstraction>& abstraction = context.abstraction;
  const HeldCells held = held_cells(context);
  const auto load = [&](Archive& archive) {
    abstraction = Abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec), .held = held};
    serialise(archive, spec, *abstraction);
  };
  const bool is_kept = work.store != nullptr && work.store->take(load) == StageStore::Kept::finished;
  if (!is_kept) abstraction = build_abstraction(spec, context.model.shapes(), work.team, held, context.ranks);
  abstraction = in_order(context.model, std::move(*abstraction));
  if (work.store == nullptr) return;
  work.store->finish(
      [&context](Archive& archive) { serialise(archive, context.spec, *context.abstraction); });
}

/// "abstraction" and "safe set": Answers::context.
/// @throws SpecError for errors that show only when the system is built
std::vector<Stage> context_stages(const ProblemSpec& /*spec*/) {
  return {{"abstraction",
           [](Answers& answers, const StageWork& work) { find_abstraction(answers.context, work); }},
          {"safe set",
           [](Answers& answers, const StageWork& work) { set_up_context(answers.context, work.team); }}};
}

void summarise_context(const Answers& answers, Json& summary, Json& /*work*/) {
  const AnalysisContext& context = answers.context;
  summary["name"] = context.spec.name;
  summary["cells"] = context.abstraction->grid.points();
  summary["joint_inputs"] = context.abstraction->inputs.count();
  // Older names of these two counts.
  summary["states"] = summary["cells"];
  summary["inputs"] = summary["joint_inputs"];
  if (context.listed) {
    summary["controller"] = {{"file", *context.spec.controller.file},
                             {"sha256", context.listed->sha256},
                             {"pairs", context.listed->pairs.count()}};
  }
  summary["safe"] = context.safe_cells;
}

}  // namespace

const Answer context_answer = {.stages = context_stages,
                               .memory = context_memory,
                               .fields = context_fields,
                               .fill = fill_context_fields,
                               .summarise = summarise_context};

}  // namespace coordreq
