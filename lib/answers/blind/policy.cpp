#include "answers/blind/answer.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "answers/one_cell/cell_members.hpp"
#include "answers/paths.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

class BlindPolicy : public CellPolicy {
 public:
  explicit BlindPolicy(const PolicyContext& context)
      : posts_(*context.posts), tables_(context.tables), countdown_(context.values(paths::kBlindCountdown)) {
    const ProblemSpec& spec = *context.spec;
    for (std::size_t c = 0; c < context.partition->classes.size(); ++c) {
      const bool has_table = has_silent_table(spec, *context.partition, c);
      classes_.push_back({.table = has_table ? paths::silent(spec, *context.partition, c) : "",
                          .seen = seen_states(spec, context.partition->classes[c])});
    }
  }

  bool holds(std::int64_t /*cell*/) override { return true; }
  const Numbers& together(std::int64_t /*cell*/, const Numbers& admissible) override { return admissible; }

  /// With no step left a class may do nothing by itself.
  std::vector<Numbers> alone(std::int64_t cell, std::int32_t countdown, const Numbers& together,
                             const std::vector<InputClass>& classes) override {
    std::vector<Numbers> actions(classes.size());
    for (std::size_t c = 0; c < classes.size() && countdown > 0; ++c)
      actions[c] =
          classes_[c].table.empty() ? classes[c].project(together) : row(classes_[c], cell, countdown);
    return actions;
  }

  std::optional<std::int32_t> countdown_after(std::int64_t cell, std::int64_t u) override {
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    std::vector<IndexRange> box;
    posts_.move_to(cell);
    for (std::size_t i = 0; i < posts_.grid().size(); ++i) {
      const ResolvedRange range = posts_.resolved(i, u);
      if (range.all_left()) return least;  // T alone
      box.push_back(range.inside);
    }
    for_each_cell(posts_.grid(), box, [&](std::int64_t next) {
      least = std::min(least, countdown_(next));
      return true;
    });
    return std::max(least, 0);
  }

 private:
  struct Class {
    std::string table;  ///< path of its table; empty: the class sees everything
    std::vector<std::size_t> seen;
  };

  /// Rows beyond the last one are equal to it.
  [[nodiscard]] Numbers row(const Class& silent_class, std::int64_t cell, std::int32_t countdown) const {
    const std::int64_t rows = tables_->length(paths::kSilentLayer);
    std::vector<std::int64_t> indices{std::min<std::int64_t>(countdown, rows) - 1};
    for (const std::size_t i : silent_class.seen) indices.push_back(posts_.grid().index(cell, i));
    const std::vector<std::uint8_t> bytes = tables_->bytes(silent_class.table, indices);
    Numbers actions;
    for (std::size_t a = 0; a < 8 * bytes.size(); ++a) {
      if ((bytes[a / 8] >> (a % 8) & 1U) != 0) actions.push_back(static_cast<std::int64_t>(a));
    }
    return actions;
  }

  CellPosts& posts_;
  const ByteTables* tables_;
  CellValue countdown_;
  std::vector<Class> classes_;
};

std::vector<std::string> silent_tables(const ProblemSpec& spec, const PartitionSpec& partition) {
  std::vector<std::string> tables;
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    if (has_silent_table(spec, partition, c)) tables.push_back(paths::silent(spec, partition, c));
  }
  return tables;
}

}  // namespace

/// Agents who see only themselves (contract, section 8): those who coordinate choose from C(x), and count
/// down from the least blind countdown of all cells that may be next, for no agent will know which of these
/// it is. Each class then chooses from the row of its silent table, by what it sees. None if all agents see
/// everything.
std::vector<AnswerPolicy> blind_policies(const ProblemSpec& spec) {
  if (!has_limited_sight(spec)) return {};
  return {{.name = kBlindKind.name,
           .kind = &kBlindKind,
           .label = "blind",
           .gain = "own observations",
           .headline = "with own observations only",
           .delay = paths::kBlindDelay,
           .trigger = paths::kBlindCountdown,
           .make = [](const PolicyContext& context) -> std::unique_ptr<CellPolicy> {
             return std::make_unique<BlindPolicy>(context);
           },
           .tables = silent_tables}};
}

}  // namespace coordreq
