#include "coordination/projections.hpp"

#include <algorithm>
#include <deque>

namespace coordreq {
namespace {

std::size_t group_offset(const RowGroups& groups, std::size_t c) {
  std::size_t offset = 0;
  for (std::size_t i = 0; i < c; ++i) offset += groups.classes[i]->size();
  return offset;
}

}  // namespace

/// Works for one thread.
template <class Level>
class Projections::Builder {
 public:
  Builder(const Controller& controller, const ActionGrouping& grouping, const RowHull& hull,
          const LevelRows<Level>& levels)
      : controller_(controller),
        grouping_(grouping),
        hull_(hull),
        posts_(*controller.engine, levels),
        lanes_(posts_.lanes(), 0),
        members_(controller.engine->row_words()) {}

  void enter() { posts_.enter(); }

  [[nodiscard]] bool is_full(const RowPlace& place) {
    if (controller_.engine->allow() != nullptr) return false;
    if (controller_.synthesis == Synthesis::given) return true;
    hull_.box(place, box_);
    if (!box_.covers) return false;
    const std::int64_t n = controller_.engine->row_length();
    posts_.kernels().spread(controller_.invariant->row(place.row).data(), lanes_.data(),
                            static_cast<std::size_t>(n));
    return posts_.kernels().is_top(posts_.minimum(box_), lanes_.data(), static_cast<std::size_t>(n));
  }

  void project(const RowPlace& place, std::vector<Word>& bits) {
    const std::size_t words = members_.size();
    grouping_.group(place, groups_);
    bits.assign(group_offset(groups_, groups_.classes.size()) * words, 0);
    for (std::size_t c = 0; c < groups_.classes.size(); ++c) {
      // An action of class c is in the projection if some action of the others goes with it; their minimal
      // ones do.
      choose_groups(groups_, GroupChoice::minimal, candidates_);
      candidates_[c] = groups_.classes[c]->all;
      tuple_.begin(grouping_, place, groups_, candidates_);
      do {
        controller_row(controller_, place.row, tuple_, posts_, members_);
        Word* target = bits.data() + (group_offset(groups_, c) + tuple_.chosen(c)) * words;
        for (std::size_t w = 0; w < words; ++w) target[w] |= members_[w];
      } while (tuple_.next());
    }
  }

 private:
  const Controller& controller_;
  const ActionGrouping& grouping_;
  const RowHull& hull_;
  PostReader<Level> posts_;
  RowGroups groups_;
  TupleWalk::Candidates candidates_;
  TupleWalk tuple_;
  RowHull::Box box_;
  std::vector<Level> lanes_;
  std::vector<Word> members_;
};

Projections::Projections(const Controller& controller, const ActionGrouping& grouping, const RowHull& hull,
                         ThreadTeam& team)
    : grouping_(&grouping),
      words_(controller.engine->row_words()),
      rows_(static_cast<std::size_t>(controller.engine->rows())) {
  const RowEngine& engine = *controller.engine;
  const std::int64_t grain = std::min<std::int64_t>(engine.unit_rows(), 64);
  controller.collision_time->visit([&]<class Level>(const LevelRows<Level>& levels) {
    std::deque<Builder<Level>> builders;
    for (int w = 0; w < team.size(); ++w) builders.emplace_back(controller, grouping, hull, levels);
    team.for_each((engine.rows() + grain - 1) / grain, 1, [&](ThreadTeam::Range range, int worker) {
      Builder<Level>& builder = builders[static_cast<std::size_t>(worker)];
      const std::int64_t end = std::min(range.end * grain, engine.rows());
      for (RowPlace place(engine.grid(), range.begin * grain); place.row < end;
           place.advance(engine.grid())) {
        // Minima are shared within a unit.
        if (place.row == range.begin * grain || place.row % engine.unit_rows() == 0) builder.enter();
        if (!any_set(controller.invariant->row(place.row)) || builder.is_full(place)) continue;
        builder.project(place, rows_[static_cast<std::size_t>(place.row)]);
      }
    });
  });
}

ConstRow Projections::row(std::int64_t row, const RowGroups& groups, std::size_t c, std::uint32_t g) const {
  return {rows_[static_cast<std::size_t>(row)].data() + (group_offset(groups, c) + g) * words_, words_};
}

}  // namespace coordreq
