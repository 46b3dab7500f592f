#include "choices/action_bits.hpp"

#include <algorithm>

#include "choices/controller_row.hpp"
#include "engine/action_groups.hpp"
#include "engine/level_map.hpp"
#include "engine/level_rows.hpp"
#include "engine/post_reader.hpp"
#include "engine/row_box.hpp"
#include "engine/row_operations.hpp"
#include "engine/tuple_walk.hpp"

namespace coordreq {
namespace {

/// Writes the sets of the cells of one row.
template <class Level>
void write_row(const Controller& controller, const ActionGrouping& grouping, std::size_t c,
               const LevelRows<Level>& levels, const RowPosition& position, PostReader<Level>& posts,
               std::uint8_t* cells) {
  const std::int64_t bytes = grouping[c].bytes();
  RowGroups groups;
  grouping.group(position, groups);
  std::vector<Word> members(controller.engine->row_words());
  std::vector<std::vector<Word>> projection(groups.classes[c]->size(), std::vector<Word>(members.size(), 0));
  TupleWalk::Candidates candidates;
  choose_groups(groups, GroupChoice::all, candidates);
  TupleWalk tuple;
  tuple.begin(grouping, position, groups, candidates);
  do {
    controller_row(controller, levels, position.row, tuple, posts, controller.engine->all_lanes(), members);
    std::vector<Word>& target = projection[tuple.chosen(c)];
    for (std::size_t w = 0; w < members.size(); ++w) target[w] |= members[w];
  } while (tuple.next());
  for (std::size_t a = 0; a < groups.classes[c]->group_of.size(); ++a)
    add_action(projection[groups.classes[c]->group_of[a]], a, bytes, cells);
}

}  // namespace

void add_action(ConstRow row, std::size_t action, std::int64_t bytes, std::uint8_t* cells) {
  for_each_bit(row, [&](std::int64_t x) {
    std::uint8_t& byte = cells[x * bytes + static_cast<std::int64_t>(action / 8)];
    byte = static_cast<std::uint8_t>(byte | 1U << (action % 8));
  });
}

std::vector<std::uint8_t> action_bits(const Controller& controller, const ActionGrouping& grouping,
                                      std::size_t c, std::int64_t first_row, std::int64_t last_row) {
  const std::int64_t length = controller.engine->row_length();
  const std::int64_t bytes = grouping[c].bytes();
  std::vector<std::uint8_t> result(static_cast<std::size_t>((last_row - first_row) * length * bytes), 0);
  controller.levels->visit([&]<class Level>(const LevelRows<Level>& levels) {
    PostReader<Level> posts(*controller.engine, levels);
    RowPosition position(controller.engine->grid(), first_row);
    for (; position.row < last_row; position.advance(controller.engine->grid())) {
      if (!any_set(controller.invariant->row(position.row))) continue;
      posts.enter(position.row);
      write_row(controller, grouping, c, levels, position, posts,
                result.data() + (position.row - first_row) * length * bytes);
    }
  });
  return result;
}

void fill_action_bits(const Controller& controller, const ActionGrouping& grouping, std::size_t c,
                      std::uint64_t begin, std::uint64_t count, void* out) {
  const auto row_bytes = static_cast<std::uint64_t>(controller.engine->row_length() * grouping[c].bytes());
  auto* target = static_cast<std::uint8_t*>(out);
  // Row by row: a segment may begin and end inside a row, and memory stays small.
  while (count > 0) {
    const std::uint64_t row = begin / row_bytes;
    const std::uint64_t offset = begin % row_bytes;
    const std::uint64_t take = std::min(count, row_bytes - offset);
    const std::vector<std::uint8_t> bits = action_bits(
        controller, grouping, c, static_cast<std::int64_t>(row), static_cast<std::int64_t>(row + 1));
    std::copy_n(bits.begin() + static_cast<std::ptrdiff_t>(offset), take, target);
    begin += take;
    count -= take;
    target += take;
  }
}

}  // namespace coordreq
