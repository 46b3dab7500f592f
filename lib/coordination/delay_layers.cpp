#include "coordination/delay_layers.hpp"

#include <algorithm>

#include "safety/find_levels.hpp"
#include "safety/set_levels.hpp"

namespace coordreq {
namespace {

/// level(x) = 1 + min over u in IND_C(x) of min over f(x,u).
template <class Level>
class IndependentActions final : public RowOperator<Level> {
 public:
  IndependentActions(const Projections& projections, const RowHull& hull, const CellSet& invariant,
                     int workers)
      : projections_(projections),
        grouping_(projections.grouping()),
        hull_(hull),
        boxes_(grouping_),
        invariant_(invariant),
        work_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPlace& place, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override {
    Workspace& work = work_[static_cast<std::size_t>(worker)];
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    hull_.box(place, work.box);
    if (work.box.covers && posts.kernels().is_settled(posts.minimum(work.box), old, n)) return false;
    std::fill_n(next, posts.lanes(), PostReader<Level>::kTop);
    switch (projections_.form(place.row)) {
      case Projections::Form::product:
        lower_by_boxes(place, posts, next, work);
        break;
      case Projections::Form::full:
        grouping_.group(place, work.groups);
        lower_by_all(place, posts, next, work);
        break;
      case Projections::Form::masks:
        grouping_.group(place, work.groups);
        lower_by_projections(place, posts, next, work);
    }
    return true;
  }

 private:
  struct Workspace {
    RowGroups groups;
    std::vector<std::vector<std::uint32_t>> worst;
    TupleWalk::Candidates candidates;
    TupleWalk tuple;
    RowHull::Box box;
    std::vector<std::vector<IndependentPosts::Entry>> entries;
    std::vector<std::vector<Word>> masks;
    std::vector<Word> reasonable;
    std::vector<Level> lanes;
  };

  void lower_by_boxes(const RowPlace& place, PostReader<Level>& posts, Level* next, Workspace& work) const {
    const std::size_t classes = grouping_.size();
    work.entries.resize(classes);
    IndependentPosts::unpack(projections_.packed(place.row), boxes_, grouping_.engine().row_words(),
                             work.entries);
    for (const auto& entries : work.entries) {
      if (entries.empty()) return;  // all that this class may do leaves for good
    }
    work.box.ranges.resize(grouping_.engine().tables() - 1);
    work.masks.assign(classes + 1, {});
    lower_by_class(0, posts, next, work);
  }

  /// Chooses a box for class c and those after it, in all ways.
  void lower_by_class(std::size_t c, PostReader<Level>& posts, Level* next, Workspace& work) const {
    if (c == grouping_.size()) return lower_by_box(posts, next, work.masks[c], work);
    for (const IndependentPosts::Entry& entry : work.entries[c]) {
      boxes_.put(c, entry.ranges, work.box);
      std::vector<Word>& mask = work.masks[c + 1];
      mask = work.masks[c];
      if (mask.empty()) {
        mask.assign(entry.mask.begin(), entry.mask.end());
      } else {
        for (std::size_t w = 0; w < entry.mask.size(); ++w) mask[w] &= entry.mask[w];
        if (!any_set(mask)) continue;
      }
      lower_by_class(c + 1, posts, next, work);
    }
  }

  /// @param mask empty: all cells of K
  void lower_by_box(PostReader<Level>& posts, Level* next, const std::vector<Word>& mask,
                    Workspace& work) const {
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    const Level* levels = posts.minimum(work.box);
    if (mask.empty()) {
      const Level* pair[] = {next, levels};
      posts.kernels().minimum(pair, 2, next, n);
    } else {
      work.lanes.resize(posts.lanes(), 0);
      posts.kernels().spread(mask.data(), work.lanes.data(), n);
      posts.kernels().lower_where(levels, work.lanes.data(), next, n);
    }
  }

  void lower_by_all(const RowPlace& place, PostReader<Level>& posts, Level* next, Workspace& work) const {
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    choose_groups(work.groups, GroupChoice::maximal, work.candidates);
    work.tuple.begin(grouping_, place, work.groups, work.candidates);
    do {
      const Level* pair[] = {next, posts.minimum(work.tuple.slice_ids())};
      posts.kernels().minimum(pair, 2, next, n);
    } while (work.tuple.next());
  }

  void lower_by_projections(const RowPlace& place, PostReader<Level>& posts, Level* next,
                            Workspace& work) const {
    const auto n = grouping_.engine().row_length();
    work.worst.resize(grouping_.size());
    work.candidates.clear();
    for (std::size_t c = 0; c < grouping_.size(); ++c) {
      find_worst(place.row, work.groups, c, work.worst[c]);
      if (work.worst[c].empty()) return;
      work.candidates.emplace_back(work.worst[c]);
    }
    work.lanes.resize(posts.lanes(), 0);
    work.tuple.begin(grouping_, place, work.groups, work.candidates);
    do {
      const ConstRow invariant = invariant_.row(place.row);
      work.reasonable.assign(invariant.begin(), invariant.end());
      for (std::size_t c = 0; c < grouping_.size(); ++c) {
        const ConstRow projection = projections_.mask(place.row, work.groups, c, work.tuple.chosen(c));
        for (std::size_t w = 0; w < projection.size(); ++w) work.reasonable[w] &= projection[w];
      }
      if (!any_set(work.reasonable)) continue;
      posts.kernels().spread(work.reasonable.data(), work.lanes.data(), static_cast<std::size_t>(n));
      posts.kernels().lower_where(posts.minimum(work.tuple.slice_ids()), work.lanes.data(), next,
                                  static_cast<std::size_t>(n));
    } while (work.tuple.next());
  }

  /// The groups of class c that can make a difference: reasonable somewhere, and not with a post inside that
  /// of another group that is reasonable wherever they are.
  void find_worst(std::int64_t row, const RowGroups& groups, std::size_t c,
                  std::vector<std::uint32_t>& result) const {
    const ActionGroups& own = *groups.classes[c];
    result.clear();
    for (std::uint32_t g = 0; g < own.size(); ++g) {
      const ConstRow projection = projections_.mask(row, groups, c, g);
      bool needed = any_set(projection);
      for (const std::uint32_t h : own.holders[g]) {
        if (!needed) break;
        const ConstRow other = projections_.mask(row, groups, c, h);
        if (!is_subset(projection, other)) continue;
        // Of two that cover each other the lower one stays.
        needed = own.is_within(h, g) && g < h && is_subset(other, projection);
      }
      if (needed) result.push_back(g);
    }
  }

  const Projections& projections_;
  const ActionGrouping& grouping_;
  const RowHull& hull_;
  RowBoxes boxes_;
  const CellSet& invariant_;
  std::vector<Workspace> work_;
};

template <class Level>
std::unique_ptr<RowOperator<Level>> make_operator(const Projections& projections, const RowHull& hull,
                                                  const CellSet& invariant, int workers) {
  return std::make_unique<IndependentActions<Level>>(projections, hull, invariant, workers);
}

/// |Z_0|, |Z_1|, ...: a cell of level i is in the first i layers.
std::vector<std::int64_t> layer_sizes(const LevelMap::Histogram& cells) {
  std::vector<std::int64_t> sizes(std::max<std::size_t>(cells.finite.size(), 1), cells.top);
  for (std::size_t level = sizes.size(); level-- > 1;) sizes[level - 1] = sizes[level] + cells.finite[level];
  return sizes;
}

/// All that follows from the levels.
void summarise(std::optional<std::int64_t> max_delay, ThreadTeam& team, DelayLayers& result) {
  result.sizes = layer_sizes(result.layers_of.histogram(team));
  const auto steps = static_cast<std::int64_t>(result.sizes.size()) - 1;
  // A fixed point is known as such only by one more step.
  result.truncated = max_delay && steps >= *max_delay && result.sizes.back() != 0;
  result.fixed_point_index = result.truncated ? -1 : static_cast<std::int32_t>(steps);
}

}  // namespace

DelayLayers find_delay_layers(const RowEngine& engine, const RowHull& hull, const CellSet& invariant,
                              const Projections& projections, const std::vector<const LevelMap*>& coarser,
                              std::optional<std::int64_t> max_delay,
                              const std::function<void(std::int64_t, std::int64_t)>& swept,
                              ThreadTeam& team) {
  const int workers = team.size();
  const LevelProblem problem{
      .start = &invariant,
      .bounds = coarser,
      .settled = &projections.full_rows(),
      .limit = max_delay.value_or(-1),
      .make8 = [&] { return make_operator<std::uint8_t>(projections, hull, invariant, workers); },
      .make16 = [&] { return make_operator<std::uint16_t>(projections, hull, invariant, workers); },
      .make32 = [&] { return make_operator<std::uint32_t>(projections, hull, invariant, workers); }};
  DelayLayers result;
  result.layers_of = find_levels(engine, hull, problem, swept, team, result.counts);
  summarise(max_delay, team, result);
  return result;
}

DelayLayers coordinated_layers(const RowEngine& engine, const CellSet& invariant,
                               std::optional<std::int64_t> max_delay, ThreadTeam& team) {
  DelayLayers result;
  result.layers_of = LevelMap(top_levels<std::uint8_t>(engine, invariant, team));
  summarise(max_delay, team, result);
  return result;
}

}  // namespace coordreq
