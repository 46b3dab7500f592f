#pragma once

#include "analysis/motion.hpp"
#include "answers/answers.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Warnings that follow from the spec alone: grids that miss the ends of their domains; states that jump at
/// samples and decide what is safe between them; constants, definitions, inputs and disturbances that nothing
/// uses.
[[nodiscard]] Warnings advise_on_spec(const ProblemSpec& spec);

/// Bounds of states in `safe` that lie within cells, with an origin or a step that makes them faces.
[[nodiscard]] Warnings advise_on_bounds(const ProblemSpec& spec);

/// Units of a small table that do not fit: a term of a derivative that is not in the unit of its state by
/// that of time, sines of degrees; unknown units, and what constants multiply, are left alone. Periodic
/// states in sin or cos whose period is no whole number of turns. In continuous time states that move by more
/// than a third of their domain in a period, or by all of it where limits hold them on both sides.
[[nodiscard]] Warnings advise_on_units(const ProblemSpec& spec, const std::vector<StateMotion>& motion);

/// Warnings that follow from posts: states that move less than a cell in a period; sides left at the default
/// `unsafe` through which pairs of safe cells are blocked. @pre the context is set up. Cost: a pass over
/// tables and S
[[nodiscard]] Warnings advise_on_posts(const AnalysisContext& context,
                                       const std::vector<StateMotion>& motion);

/// Discrete states of which some post holds a value that cannot follow, since posts are ranges. @pre as
/// advise_on_posts(), on the whole grid. Cost: a pass over their tables, and a fixed amount of work
[[nodiscard]] Warnings advise_on_numbering(const AnalysisContext& context);

/// Warnings that follow from K and the delays: K is empty, or no cell tolerates any silence, with the changes
/// that would help. To find these, one rule, disturbance, error or step after the other is relaxed on a copy
/// with at most some 10^5 cells, within a fixed amount of work: the same on every machine. A relaxed problem
/// that cannot be analysed is passed over. @pre K and the layers are there
/// @param creeps advise_on_standing() has said so: then a finer grid is not what helps
/// @param work takes what the trials did: `helpers/advice` with `trials` and `work`, about a nanosecond each
[[nodiscard]] Warnings advise_on_answers(const Answers& answers, bool creeps, ThreadTeam& team, Json& work);

/// All that is known without the answer: from all posts where they are few, else from some of them.
/// @param motion of the spec @param posts of look_ahead()
/// @throws SpecError where the analysis does, as far as posts are looked at
[[nodiscard]] Warnings advise_before(const Model& model, const std::vector<StateMotion>& motion,
                                     std::int64_t posts, ThreadTeam& team);
/// All of them. @param work takes counts of what was done for them. @pre as advise_on_answers()
[[nodiscard]] Warnings advise(const Answers& answers, const std::vector<StateMotion>& motion,
                              ThreadTeam& team, Json& work);

/// A list of objects with `kind`, `place` and `message`.
[[nodiscard]] Json warnings_json(const Warnings& warnings);

}  // namespace coordreq
