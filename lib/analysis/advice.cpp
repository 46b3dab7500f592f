#include "analysis/advice.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "answers/context/answer.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/layers/answer.hpp"
#include "answers/plan.hpp"
#include "base/requires.hpp"
#include "reach/enclosure_sample.hpp"
#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Whether posts can be had at little cost.
bool has_few_posts(const Model& model) {
  constexpr std::int64_t kMostCells = 1'000'000;
  constexpr double kMostEntries = 2e4;
  return model.spec().cells() <= kMostCells && entries_of(model.shapes()) <= kMostEntries &&
         !model.spec().controller.file;
}

/// Whether a sample of the boxes that are enclosed for all posts says that they take little.
bool has_little_to_enclose(const Model& model) {
  constexpr int kBoxes = 8;
  constexpr double kMostWork = 1e5;  // some seconds
  const auto of_all = [](const EnclosureSample& sample) {
    return static_cast<double>(sample.work()) / kBoxes * sample.choices();
  };
  double work = 0;
  for (const EnclosedGroup& group : enclosed_groups(model.spec(), model.shapes())) {
    EnclosureSample sample(model.spec(), group);
    for (int k = 0; k < kBoxes && sample.choices() > kBoxes; ++k) {
      sample.enclose_next();
      if (work + of_all(sample) > kMostWork) return false;
    }
    work += of_all(sample);
  }
  return true;
}

void add(Warnings more, Warnings& all) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The warnings of a single process, from K or from S alone. @param posts of look_ahead(); 0: it is not
/// called
Warnings advise_alone(const Model& model, const std::vector<StateMotion>& motion, bool finds_invariance,
                      std::int64_t posts, ThreadTeam& team, SearchWork& search) {
  Warnings all = advise_on_spec(model.spec());
  add(advise_on_bounds(model.spec()), all);
  add(advise_on_units(model.spec(), motion), all);
  if (!has_few_posts(model) || (posts > 0 && !has_little_to_enclose(model))) {
    if (posts > 0) add(look_ahead(model, posts, team), all);
    return all;
  }
  Answers answers(model);
  run_stages(context_answer.stages(model.spec()), answers, {.team = team});
  if (posts > 0 && answers.context.safe_cells == 0)
    all.push_back({"empty", "/safe", "the safe set is empty on this grid"});
  if (finds_invariance) run_stages(invariance_answer.stages(model.spec()), answers, {.team = team});
  add(advise_on_posts(answers.context, motion), all);
  add(advise_on_numbering(answers.context), all);
  add(advise_on_unseen_motion(answers.context,
                              finds_invariance ? answers.get<Invariance>().invariant : answers.context.safe,
                              team, search),
      all);
  if (finds_invariance) add(advise_on_standing(answers.context, answers.get<Invariance>().invariant), all);
  return all;
}

}  // namespace

Warnings advise_before(const Model& model, const std::vector<StateMotion>& motion, std::int64_t posts,
                       ThreadTeam& team) {
  SearchWork search;
  return advise_alone(model, motion, false, posts, team, search);
}

Warnings advise(const Answers& answers, const std::vector<StateMotion>& motion, ThreadTeam& team,
                Json& work) {
  REQUIRES(answers.find<Invariance>() != nullptr && answers.find<PartitionLayers>() != nullptr);
  Warnings all;
  SearchWork search;
  if (answers.context.share) {  // no process has all of S and K: small ones are found once more
    all = advise_alone(answers.context.model, motion, true, 0, team, search);
  } else {
    all = advise_on_spec(answers.context.spec);
    add(advise_on_bounds(answers.context.spec), all);
    add(advise_on_units(answers.context.spec, motion), all);
    add(advise_on_posts(answers.context, motion), all);
    add(advise_on_numbering(answers.context), all);
    add(advise_on_unseen_motion(answers.context, answers.get<Invariance>().invariant, team, search), all);
    add(advise_on_standing(answers.context, answers.get<Invariance>().invariant), all);
  }
  const bool creeps =
      std::ranges::any_of(all, [](const Warning& warning) { return warning.kind == "standing"; });
  work["helpers"]["unseen motion"] = {{"reads", search.reads}, {"solutions", search.followed}};
  add(advise_on_answers(answers, creeps, team, work), all);
  for (const Answer& answer : all_answers()) {
    if (answer.advise != nullptr) add(answer.advise(answers), all);
  }
  return all;
}

Json warnings_json(const Warnings& warnings) {
  Json json = Json::array();
  for (const Warning& warning : warnings)
    json.push_back({{"kind", warning.kind}, {"place", warning.pointer}, {"message", warning.text}});
  return json;
}

}  // namespace coordreq
