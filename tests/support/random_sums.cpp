#include "support/random_sums.hpp"

#include <rapidcheck.h>

#include "support/draw.hpp"

namespace coordreq {
namespace {

std::vector<std::int32_t> some(std::size_t below) {
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < below; ++i) {
    if (draw(0, 1) == 0) result.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

/// A fixed-point number of steps, often a whole one, where floors jump.
std::int64_t steps(int low, int high) {
  const std::int64_t whole = std::int64_t{draw(low, high)} << TransitionTable::kFractionBits;
  return draw(0, 2) == 0 ? whole : whole + (std::int64_t{draw(-8, 8)} << 29) + draw(-1, 1);
}

/// Strides of an array over some variables, row-major, from `entries` on.
void lay_out_over(const std::vector<std::int32_t>& variables, const auto& count, std::int64_t& entries,
                  std::vector<std::int64_t>& stride) {
  for (const std::int32_t j : variables) {
    stride[static_cast<std::size_t>(j)] = entries;
    entries *= count(static_cast<std::size_t>(j));
  }
}

class SumWriter {
 public:
  explicit SumWriter(Abstraction& abstraction) : abstraction_(abstraction) {}

  void lead(std::size_t t) {
    TransitionTable table{.inputs = some(abstraction_.inputs.size())};
    table.states = {static_cast<std::int32_t>(t)};
    table.shift = draw(0, 1) == 0;
    table.entries.resize(static_cast<std::size_t>(lay_out(table, t, abstraction_.grid, abstraction_.inputs)));
    for (IndexRange& entry : table.entries) {
      entry.first =
          draw(-1, 1) + (table.shift ? 0 : draw(0, static_cast<int>(abstraction_.grid[t].count) - 1));
      entry.last = entry.first + draw(0, 2);
    }
    abstraction_.tables[t] = std::move(table);
  }

  void sum(std::size_t t, std::size_t leading) {
    const std::size_t last = abstraction_.grid.size() - 1;
    TransitionTable table{.inputs = some(abstraction_.inputs.size())};
    for (std::size_t i = 0; i <= last; ++i) table.states.push_back(static_cast<std::int32_t>(i));
    table.shift = draw(0, 1) == 0;
    for (std::size_t j = leading; j <= last; ++j) {
      if (j == t && table.shift) continue;
      if (j != last && draw(0, 2) == 0) continue;
      add_term(table, j, leading, j == t);
    }
    if (table.terms.empty()) add_term(table, last, leading, false);
    const auto entries = static_cast<std::size_t>(lay_out(table, t, abstraction_.grid, abstraction_.inputs));
    for (std::size_t i = 0; i < entries; ++i) {
      table.base_lower.push_back(steps(-1, 1));
      table.base_upper.push_back(table.base_lower.back() + (std::int64_t{draw(0, 6)} << 30));
    }
    abstraction_.tables[t] = std::move(table);
  }

 private:
  void add_term(TransitionTable& table, std::size_t state, std::size_t leading, bool is_own) {
    TransitionTerm term{.state = static_cast<std::int32_t>(state)};
    term.state_stride.assign(abstraction_.grid.size(), 0);
    term.input_stride.assign(abstraction_.inputs.size(), 0);
    term.state_stride[state] = 1;
    std::int64_t entries = abstraction_.grid[state].count;
    lay_out_over(
        some(leading), [&](std::size_t j) { return abstraction_.grid[j].count; }, entries, term.state_stride);
    std::vector<std::int32_t> inputs;
    for (const std::int32_t j : table.inputs) {
      if (draw(0, 1) == 0) inputs.push_back(j);
    }
    lay_out_over(
        inputs, [&](std::size_t j) { return abstraction_.inputs[j].count(); }, entries, term.input_stride);
    for (std::int64_t i = 0; i < entries; ++i) {
      const std::int64_t own =
          is_own ? i % abstraction_.grid[state].count << TransitionTable::kFractionBits : 0;
      term.lower.push_back(own + steps(-1, 1) / 2);
      term.upper.push_back(term.lower.back() + (std::int64_t{draw(0, 2)} << 30));
    }
    table.terms.push_back(std::move(term));
  }

  Abstraction& abstraction_;
};

}  // namespace

void draw_sums(Abstraction& abstraction) {
  const auto states = static_cast<int>(abstraction.grid.size());
  const auto leading = static_cast<std::size_t>(draw(1, states - 1));
  SumWriter writer(abstraction);
  for (std::size_t t = 0; t < abstraction.grid.size(); ++t)
    t < leading ? writer.lead(t) : writer.sum(t, leading);
}

}  // namespace coordreq
