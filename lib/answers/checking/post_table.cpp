#include "answers/checking/post_table.hpp"

#include "model/odometer.hpp"

namespace coordreq {

std::vector<bool> entries_of(const UniformGrid& grid, const InputSpace& inputs, const PostTable& table,
                             const std::vector<std::int64_t>& cells) {
  if (cells.empty()) return {};
  std::vector<std::int64_t> counts;
  for (const std::size_t j : table.inputs) counts.push_back(inputs[j].count());
  std::vector<bool> asked(table.entries.size());
  for (const std::int64_t cell : cells) {
    const std::int64_t first = table.first_entry(grid, cell);
    Odometer choice(counts);
    do {
      std::int64_t entry = first;
      for (std::size_t j = 0; j < counts.size(); ++j)
        entry += choice[j] * table.input_stride[table.inputs[j]];
      asked[static_cast<std::size_t>(entry)] = true;
    } while (choice.advance());
  }
  return asked;
}

}  // namespace coordreq
