#include "answers/convention/answer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "answers/checking/all_checks.hpp"
#include "answers/invariance/answer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

bool is_share(float freedom) {
  return std::isnan(freedom) || (freedom > 0 && freedom <= 1);
}

/// @pre unchecked: the agents are there.
void serialise(Archive& archive, const RowEngine& engine, ConventionFreedom& convention) {
  const std::int64_t cells = engine.grid().cells(), length = engine.row_length();
  const RowShare::Range local = local_rows(engine.share(), engine.rows());
  for (ConventionFreedom::Agent& agent : convention.agents) {
    auto& [freedom, mean, full, histogram] = agent;  // every member, so that none is forgotten
    if (archive.is_loading()) freedom = ZeroedArray<float>(static_cast<std::size_t>(cells));
    archive.grid_rows(number_rows(freedom.data(), length, engine.rows(), length), local, {&local, 1});
    archive.number(mean);
    archive.number(full);
    for (std::int64_t& count : histogram) archive.number(count);
    const auto is_count = [cells](std::int64_t count) { return 0 <= count && count <= cells; };
    archive.expect(
        std::all_of(freedom.begin() + local.begin * length, freedom.begin() + local.end * length, is_share) &&
            mean >= 0 && mean <= 1.0000001 && is_count(full) &&
            std::all_of(histogram.begin(), histogram.end(), is_count),
        "an agent keeps a part of its actions that is none");
  }
}

/// Joins the conventions of two parts of the cells.
/// @param rows that are owned, of `length` lanes
void add(const ConventionFreedom& other, std::int64_t cells, std::int64_t other_cells, RowShare::Range rows,
         std::int64_t length, ConventionFreedom& result) {
  for (std::size_t i = 0; i < result.agents.size(); ++i) {
    ConventionFreedom::Agent& agent = result.agents[i];
    const ConventionFreedom::Agent& more = other.agents[i];
    const auto [begin, end] = rows;
    for (auto x = static_cast<std::size_t>(begin * length); x < static_cast<std::size_t>(end * length); ++x) {
      if (!std::isnan(more.freedom[x])) agent.freedom[x] = more.freedom[x];
    }
    const auto n = static_cast<double>(cells), m = static_cast<double>(other_cells);
    if (other_cells > 0) agent.mean = (agent.mean * n + more.mean * m) / (n + m);
    agent.full += more.full;
    for (std::size_t k = 0; k < agent.histogram.size(); ++k) agent.histogram[k] += more.histogram[k];
  }
}

ConventionFreedom find_freedom(const AnalysisContext& context, const ConventionAnswer& convention,
                               ThreadTeam& team) {
  const RowEngine& engine = *context.engine;
  ConventionFreedom result;
  std::int64_t cells = 0;
  for (std::size_t k = 0; k < convention.agents.size(); ++k) {
    const PartialController& piece = convention.controller->pieces[k];
    const CellSet& invariant = *piece.controller.invariant;
    std::optional<Tiles> tiles;
    // Not with a goal: then posts must stay in more cells than those of the part, or come nearer.
    if (convention.agents.size() == 1) tiles = Tiles::find(*piece.controller.engine, *piece.hull, invariant);
    ConventionFreedom freedom =
        find_convention(piece.controller, convention.agents[k], team, tiles ? &*tiles : nullptr);
    const std::int64_t count = context.count(invariant);
    if (k == 0) {
      result = std::move(freedom);
    } else {
      add(freedom, cells, count, local_rows(engine.share(), engine.rows()), engine.row_length(), result);
    }
    cells += count;
  }
  return result;
}

void find_a_convention(Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  ConventionAnswer& result = answers.add(ConventionAnswer{piecewise_controller(answers, false), {}, {}});
  const std::vector<InputClass> agents = agent_classes(context.spec, context.abstraction->inputs);
  for (const PartialController& piece : result.controller->pieces)
    result.agents.emplace_back(*piece.controller.engine, agents, work.team);
  const auto exchange = [&answers](Archive& archive) {
    serialise(archive, *answers.context.engine, answers.get<ConventionAnswer>().freedom);
  };
  const auto load = [&](Archive& archive) {
    result.freedom.agents.resize(context.spec.agents.size());
    exchange(archive);
  };
  const bool is_kept = work.store != nullptr && work.store->take(load) == StageStore::Kept::finished;
  if (!is_kept) result.freedom = find_freedom(context, result, work.team);
  if (work.store != nullptr) work.store->finish(exchange);
}

/// Adds ConventionAnswer, if the spec asks for one: "convention".
std::vector<Stage> convention_stages(const ProblemSpec& spec) {
  if (!spec.coordination.convention) return {};
  return {{"convention", find_a_convention}};
}

void summarise_convention(const Answers& answers, Json& summary, Json& /*work*/) {
  const auto* const convention = answers.find<ConventionAnswer>();
  if (convention == nullptr) return;
  const std::vector<AgentSpec>& agents = answers.context.spec.agents;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const ConventionFreedom::Agent& agent = convention->freedom.agents[i];
    summary["convention"].push_back(Json{{"agent", agents[i].name},
                                         {"mean", agent.mean},
                                         {"full", agent.full},
                                         {"histogram", agent.histogram}});
  }
}

MemoryNeed convention_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!spec.coordination.convention) return {};
  const auto agents = static_cast<double>(spec.agents.size());
  const double freedom = agents * sizes.lanes() * sizeof(float);
  // With a goal there are two parts, one after the other.
  const double pieces = spec.goal ? 2 : 1;
  constexpr double kLikeRows = 4;  // words of a row, for the numbers of equal rows
  return {.kept = pieces * sizes.groups(agent_classes(spec, sizes.model().inputs())) + freedom +
                  (pieces - 1) * sizes.set(),
          .work = sizes.readers(threads) + (agents + kLikeRows) * sizes.rows() * sizeof(double) +
                  (pieces - 1) * freedom,
          .written = sizes.readers(threads),
          .array = freedom};
}

}  // namespace

const Answer convention_answer = {.stages = convention_stages,
                                  .memory = convention_memory,
                                  .fields = convention_fields,
                                  .fill = fill_convention_fields,
                                  .summarise = summarise_convention,
                                  .policies = convention_policies,
                                  .explain = explain_convention,
                                  .check = check_convention};

}  // namespace coordreq
