#include "analysis/saved_lists.hpp"

#include <bit>

#include "base/error.hpp"

namespace coordreq {
namespace {

/// Calls `visit` with every list of a table, always in the same order.
template <class Table, class Visit>
void for_each_list(Table& table, const Visit& visit) {
  visit(table.states);
  visit(table.inputs);
  visit(table.entries);
  for (auto& term : table.terms) {
    visit(term.state_stride);
    visit(term.input_stride);
    visit(term.lower);
    visit(term.upper);
  }
  visit(table.base_lower);
  visit(table.base_upper);
  visit(table.state_stride);
  visit(table.input_stride);
}

template <class Element>
std::int64_t size_of(const std::vector<Element>& list) {
  static_assert(std::is_trivially_copyable_v<Element>);
  return static_cast<std::int64_t>(list.size() * sizeof(Element));
}

template <class Element>
RowBytes bytes_of(const std::vector<Element>& list) {
  const std::int64_t bytes = size_of(list);
  const void* first = list.data();
  return {static_cast<const std::byte*>(first), bytes, bytes == 0 ? 0 : 1, bytes, 1};
}

template <class Element>
void fill(std::vector<Element>& list, const ReadList& read) {
  void* first = list.data();
  if (!list.empty()) read(static_cast<std::byte*>(first), static_cast<std::uint64_t>(size_of(list)));
}

void save(const TransitionTable& table, SavedLists& saved) {
  saved.numbers.push_back(table.shift ? 1 : 0);
  saved.numbers.push_back(table.terms.size());
  for (const TransitionTerm& term : table.terms)
    saved.numbers.push_back(static_cast<std::uint64_t>(term.state));
  for_each_list(table, [&](const auto& list) {
    saved.numbers.push_back(list.size());
    saved.lists.push_back(bytes_of(list));
  });
}

/// Hands out the numbers of SavedLists again.
class Numbers {
 public:
  explicit Numbers(const std::vector<std::uint64_t>& numbers) : numbers_(numbers) {}

  std::uint64_t next() {
    if (position_ == numbers_.size()) throw ResultsError("saved lists do not fit the spec");
    return numbers_[position_++];
  }

 private:
  const std::vector<std::uint64_t>& numbers_;
  std::size_t position_ = 0;
};

void load(Numbers& numbers, const ReadList& read, TransitionTable& table) {
  table.shift = numbers.next() != 0;
  table.terms.resize(numbers.next());
  for (TransitionTerm& term : table.terms) term.state = static_cast<std::int32_t>(numbers.next());
  for_each_list(table, [&](auto& list) {
    list.resize(numbers.next());
    fill(list, read);
  });
}

}  // namespace

SavedLists save(const Abstraction& abstraction) {
  SavedLists saved;
  saved.numbers = {abstraction.exact ? std::uint64_t{1} : 0, abstraction.tables.size(),
                   abstraction.tubes.size()};
  for (const TransitionTable& table : abstraction.tables) save(table, saved);
  for (const TransitionTable& tube : abstraction.tubes) save(tube, saved);
  return saved;
}

Abstraction load_abstraction(const ProblemSpec& spec, const std::vector<std::uint64_t>& numbers,
                             const ReadList& read) {
  Abstraction abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec)};
  Numbers left(numbers);
  abstraction.exact = left.next() != 0;
  abstraction.tables.resize(left.next());
  abstraction.tubes.resize(left.next());
  for (TransitionTable& table : abstraction.tables) load(left, read, table);
  for (TransitionTable& tube : abstraction.tubes) load(left, read, tube);
  return abstraction;
}

SavedLists save(const ConventionFreedom& freedom) {
  SavedLists saved;
  for (const ConventionFreedom::Agent& agent : freedom.agents) {
    saved.numbers.push_back(std::bit_cast<std::uint64_t>(agent.mean));
    saved.numbers.push_back(static_cast<std::uint64_t>(agent.full));
    for (const std::int64_t cells : agent.histogram)
      saved.numbers.push_back(static_cast<std::uint64_t>(cells));
    saved.lists.push_back(bytes_of(agent.freedom));
  }
  return saved;
}

ConventionFreedom load_convention(std::size_t agents, std::int64_t cells,
                                  const std::vector<std::uint64_t>& numbers, const ReadList& read) {
  ConventionFreedom freedom{.agents = std::vector<ConventionFreedom::Agent>(agents)};
  Numbers left(numbers);
  for (ConventionFreedom::Agent& agent : freedom.agents) {
    agent.mean = std::bit_cast<double>(left.next());
    agent.full = static_cast<std::int64_t>(left.next());
    for (std::int64_t& count : agent.histogram) count = static_cast<std::int64_t>(left.next());
    agent.freedom.resize(static_cast<std::size_t>(cells));
    fill(agent.freedom, read);
  }
  return freedom;
}

}  // namespace coordreq
