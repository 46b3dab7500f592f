#pragma once

#include <cstdint>
#include <vector>

#include "analysis/motion.hpp"
#include "answers/analysis_context.hpp"
#include "answers/answers.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"
#include "base/thread_team.hpp"
#include "model/model.hpp"
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
/// that cannot be analysed is skipped. @pre K and the layers are there
/// @param creeps advise_on_standing() has said so: then a finer grid is not what helps
/// @param work takes what the trials did: `helpers/advice` with `trials` and `work`, about a nanosecond each
[[nodiscard]] Warnings advise_on_answers(const Answers& answers, bool creeps, ThreadTeam& team, Json& work);

/// All that is known without the answer: from all posts where they are few and take little work, by a
/// sample, else from some of them.
/// @param motion of the spec @param posts of look_ahead()
/// @throws SpecError where the analysis does, as far as posts are looked at
[[nodiscard]] Warnings advise_before(const Model& model, const std::vector<StateMotion>& motion,
                                     std::int64_t posts, ThreadTeam& team);
/// All of them. @param work takes counts of what was done for them. @pre as advise_on_answers()
[[nodiscard]] Warnings advise(const Answers& answers, const std::vector<StateMotion>& motion,
                              ThreadTeam& team, Json& work);

/// A list of objects with `kind`, `place` and `message`.
[[nodiscard]] Json warnings_json(const Warnings& warnings);

/// The number of pairs of a safe cell and a joint input that are blocked at a side of the domain.
struct BlockedPairs {
  std::int64_t pairs = 0;
  bool is_all = true;  ///< else there may be more: the search was broken off after some millions
};

/// @param dimension of the grid of the abstraction, and its side
/// @param may_leave by the index of the state: false where no post goes beyond that side
/// @pre the context is set up
[[nodiscard]] BlockedPairs count_blocked(const AnalysisContext& context, std::size_t dimension, bool above,
                                         const std::vector<bool>& may_leave);

/// A state of S at rest at the limit of a `stop` side, with an input under which nothing moves, whose cell is
/// not in K. The cell around a limit holds everything from the limit to half a step beside it, a vehicle that
/// stands and others that creep; so its reachable set spreads to the next position at every step, on every
/// grid. Centres of cells are looked at where all states with such a side are at it: some thousand cells, and
/// some inputs; none found proves nothing. Nothing is said where there is no choice (`given`, a controller
/// file), where memories are kept, or where a state at rest would depend on a disturbance.
/// @param invariant K @pre the context is set up, by one process; the set has its rows
[[nodiscard]] Warnings advise_on_standing(const AnalysisContext& context, const CellSet& invariant);

/// What an analysis would find at once, without the whole of its tables: within a bounded amount of work,
/// which no clock decides.
///
/// 1. Equations are evaluated on boxes of cells, halved where they may be undefined, down to single cells,
///    whose posts are then computed; so are those of some cells drawn at random.
/// 2. `safe` is evaluated likewise: if it is false in all boxes, no cell satisfies it.
///
/// Tables that are sums are left out: they are small. An example: `1/x` on 10^9 cells takes some 60 boxes
/// to come to the cell at x = 0.
/// @param posts about so many entries of tables are computed, and ten times as many boxes looked at
/// @returns a warning if nothing satisfies `safe` @throws SpecError as build_abstraction()
[[nodiscard]] Warnings look_ahead(const Model& model, std::int64_t posts, ThreadTeam& team);

/// What a search did: reads of tables and sets, and solutions followed.
struct SearchWork {
  std::int64_t reads = 0;
  std::int64_t followed = 0;
};

/// Where safety is required at samples only: a motion from one cell of a set to others of it, under an
/// admissible joint input, that passes cells outside S in between. Tried on a sample: a fixed amount of work,
/// the same on every machine and no more than a sixteenth of a read a cell on large grids. Cells are chosen
/// by the straight line to the middle of their post, and then followed from their centre with disturbances in
/// the middle, without a guarantee; whoever finds none has proved nothing. Of those found it reports the
/// first where the condition itself fails, else the first.
/// @param kept K, or S where K is not known
/// @pre the context is set up, by one process; `kept` has its rows
[[nodiscard]] Warnings advise_on_unseen_motion(const AnalysisContext& context, const CellSet& kept,
                                               ThreadTeam& team, SearchWork& work);

}  // namespace coordreq
