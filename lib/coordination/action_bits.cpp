#include "coordination/action_bits.hpp"

#include <algorithm>

#include "safety/invariance.hpp"

namespace coordreq {
namespace {

std::int64_t bytes_for(std::int64_t actions) {
  return (actions + 7) / 8;
}

}  // namespace

std::vector<std::uint8_t> action_bits(const Controller& controller, const ActionGrouping& grouping,
                                      std::size_t c, std::int64_t first_row, std::int64_t last_row) {
  const std::int64_t length = controller.engine->row_length();
  const std::int64_t bytes = bytes_for(grouping.actions(c));
  std::vector<std::uint8_t> result(static_cast<std::size_t>((last_row - first_row) * length * bytes), 0);
  RowEngine::Scratch scratch;
  RowGroups groups;
  std::vector<Word> members(controller.engine->row_words());
  for (std::int64_t row = first_row; row < last_row; ++row) {
    if (!any_set(controller.invariant->set().row(row))) continue;
    std::uint8_t* cells = result.data() + (row - first_row) * length * bytes;
    grouping.group(row, groups);
    std::vector<std::vector<Word>> projection(groups.classes[c]->size(),
                                              std::vector<Word>(members.size(), 0));
    ActionGrouping::Tuples tuple(grouping, row, groups, ActionGrouping::all_groups(groups));
    do {
      controller_row(controller, row, tuple, members, scratch);
      std::vector<Word>& target = projection[tuple.chosen(c)];
      for (std::size_t w = 0; w < members.size(); ++w) target[w] |= members[w];
    } while (tuple.next());
    for (std::size_t a = 0; a < groups.classes[c]->group_of.size(); ++a) {
      for_each_bit(projection[groups.classes[c]->group_of[a]], [&](std::int64_t x) {
        std::uint8_t& byte = cells[x * bytes + static_cast<std::int64_t>(a / 8)];
        byte = static_cast<std::uint8_t>(byte | 1U << (a % 8));
      });
    }
  }
  return result;
}

void fill_action_bits(const Controller& controller, const ActionGrouping& grouping, std::size_t c,
                      std::uint64_t begin, std::uint64_t count, void* out) {
  const auto row_bytes =
      static_cast<std::uint64_t>(controller.engine->row_length() * bytes_for(grouping.actions(c)));
  auto* target = static_cast<std::uint8_t*>(out);
  // Row by row: a stretch may begin and end inside a row, and memory stays small.
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
