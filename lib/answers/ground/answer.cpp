#include "answers/ground/answer.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "answers/row_cut.hpp"
#include "engine/join_rows.hpp"
#include "model/model.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/serialise_abstraction.hpp"
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
HeldCells held_cells(Ground& ground) {
  const Model& model = ground.model;
  if (ground.ranks == nullptr || !is_cut_before_tables(model))
    return {.order = model.order(), .begin = 0, .end = model.grid().points()};
  ground.share.emplace(*ground.ranks, cut_into_shares(model, nullptr, ground.ranks->count()));
  const RowShare::Range rows = ground.share->own();
  const std::int64_t row = model.grid().row_length();
  return {.order = model.order(), .begin = rows.begin * row, .end = rows.end * row};
}

/// Finds the abstraction, or takes the kept one, which is in the order of the spec but for tables by cells.
void find_abstraction(Ground& ground, const StageWork& work) {
  const ProblemSpec& spec = ground.spec;
  std::optional<Abstraction>& abstraction = ground.abstraction;
  const HeldCells held = held_cells(ground);
  const auto load = [&](Archive& archive) {
    abstraction = Abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec), .held = held};
    serialise(archive, spec, *abstraction);
  };
  const bool is_kept = work.store != nullptr && work.store->take(load) == StageStore::Kept::finished;
  if (!is_kept) abstraction = build_abstraction(spec, ground.model.shapes(), work.team, held, ground.ranks);
  abstraction = in_order(ground.model, std::move(*abstraction));
  if (work.store == nullptr) return;
  work.store->finish([&ground](Archive& archive) { serialise(archive, ground.spec, *ground.abstraction); });
}

}  // namespace

std::vector<Stage> ground_stages(const ProblemSpec& /*spec*/) {
  return {
      {"abstraction",
       [](Answers& answers, const StageWork& work) { find_abstraction(answers.ground, work); }},
      {"safe set", [](Answers& answers, const StageWork& work) { lay_ground(answers.ground, work.team); }}};
}

void summarise_ground(const Answers& answers, Json& summary, Json& /*work*/) {
  const Ground& ground = answers.ground;
  summary["name"] = ground.spec.name;
  summary["cells"] = ground.abstraction->grid.points();
  summary["joint_inputs"] = ground.abstraction->inputs.count();
  // Older names of these two counts.
  summary["states"] = summary["cells"];
  summary["inputs"] = summary["joint_inputs"];
  if (ground.listed) {
    summary["controller"] = {{"file", *ground.spec.controller.file},
                             {"sha256", ground.listed->sha256},
                             {"pairs", ground.listed->pairs.count()}};
  }
  summary["safe"] = ground.safe_cells;
}

}  // namespace coordreq
