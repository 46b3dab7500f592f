#include "results/element_owners.hpp"

#include <algorithm>

namespace coordreq {

int CellOwners::owner_of(std::uint64_t element) const {
  const auto cells = static_cast<std::uint64_t>(order_.cells());
  int owner = 0;
  order_.for_each_run(static_cast<std::int64_t>(element / of_cell_ % cells), 1,
                      [&](const CellOrder::Run& run) { owner = share_.owner(run.row); });
  return owner;
}

void CellOwners::for_each_run(std::uint64_t begin, std::uint64_t count, const Visit& visit) const {
  const std::uint64_t end = begin + count;
  const auto cells = static_cast<std::uint64_t>(order_.cells());
  const auto add = [&](int owner, std::uint64_t first, std::uint64_t length) {
    const std::uint64_t from = std::max(first * of_cell_, begin);
    visit(owner, from, std::min((first + length) * of_cell_, end) - from);
  };
  const std::uint64_t last = (end + of_cell_ - 1) / of_cell_;
  for (std::uint64_t cell = begin / of_cell_; cell < last;) {
    const std::uint64_t here = std::min(last - cell, cells - cell % cells);
    order_.for_each_run(
        static_cast<std::int64_t>(cell % cells), static_cast<std::int64_t>(here), [&](const auto& run) {
          for (std::int64_t i = 0; i < run.count;) {
            const std::int64_t row = run.row + i * run.row_step;
            const int owner = share_.owner(row);
            std::int64_t length = run.count - i;
            if (run.row_step != 0)
              length = std::min(length, (share_.run_of(owner).end - 1 - row) / run.row_step + 1);
            add(owner, cell + static_cast<std::uint64_t>(run.offset + i), static_cast<std::uint64_t>(length));
            i += length;
          }
        });
    cell += here;
  }
}

ListOwners::ListOwners(const std::vector<std::int64_t>& sizes, int ranks)
    : ranks_(static_cast<std::size_t>(ranks)), start_{0} {
  for (const std::int64_t size : sizes) start_.push_back(start_.back() + static_cast<std::uint64_t>(size));
}

std::size_t ListOwners::run_of_element(std::uint64_t element) const {
  return static_cast<std::size_t>(std::upper_bound(start_.begin(), start_.end() - 1, element) -
                                  start_.begin()) -
         1;
}

int ListOwners::owner_of(std::uint64_t element) const {
  return static_cast<int>(run_of_element(element) % ranks_);
}

void ListOwners::for_each_run(std::uint64_t begin, std::uint64_t count, const Visit& visit) const {
  const std::uint64_t end = begin + count;
  for (std::size_t run = run_of_element(begin); begin < end; ++run) {
    const std::uint64_t next = std::min(start_[run + 1], end);
    if (next > begin) visit(static_cast<int>(run % ranks_), begin, next - begin);
    begin = next;
  }
}

}  // namespace coordreq
