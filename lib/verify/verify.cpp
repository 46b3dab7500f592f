#include "verify/verify.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "answers/checking/answer_check.hpp"
#include "answers/plan.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"
#include "verify/analysis_tables.hpp"
#include "verify/checks.hpp"
#include "verify/outward_posts.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {
namespace {

void append(std::vector<Finding>& all, std::vector<Finding> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

/// Different cells, ascending; the same for the same numbers.
std::vector<std::int64_t> drawn_cells(std::int64_t cells, std::int64_t wanted) {
  std::mt19937_64 random(20180410);
  std::set<std::int64_t> drawn;
  while (static_cast<std::int64_t>(drawn.size()) < wanted)
    drawn.insert(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(cells)));
  return {drawn.begin(), drawn.end()};
}

class Verifier {
 public:
  Verifier(const ProblemSpec& spec, const Claims& claims, const VerifyOptions& options, ThreadTeam& team)
      : spec_(spec),
        claims_(claims),
        options_(options),
        team_(team),
        grid_(make_grid(spec)),
        inputs_(make_input_space(spec)),
        context_{
            .spec = &spec, .grid = &grid_, .inputs = &inputs_, .claims = &claims, .is_full = options.full} {
    for (const Answer& answer : all_answers()) {
      if (answer.check == nullptr) continue;
      if (std::unique_ptr<AnswerCheck> check = answer.check(context_)) checks_.push_back(std::move(check));
    }
    std::stable_sort(checks_.begin(), checks_.end(),
                     [](const auto& a, const auto& b) { return a->section() < b->section(); });
    requested_ = std::min(options.sample.value_or(grid_.cells()), grid_.cells());
    const std::int64_t sample = std::min(requested_, most_cells());
    if (sample < grid_.cells()) sample_ = drawn_cells(grid_.cells(), sample);
    if (!sample_.empty()) cells_of_posts_ = with_paths(sample_);
  }

  Verification run() {
    result_.name = spec_.name;
    if (claims_.listed) result_.given.emplace_back("/controller:file");
    result_.cells = grid_.cells();
    compare_sizes();
    report({.stage = "posts"});
    find_posts();
    if (spec_.abstraction.between_samples) find_tubes();
    result_.work = {.spent = budget_->spent(), .budget = budget_->all(), .left_open = budget_->left_open()};
    if (analysis_) result_.posts_computed = analysis_->entries_built();
    check_answers(make_posts(grid_, inputs_, tables_));
    return std::move(result_);
  }

 private:
  void report(const VerifyProgress& progress) const {
    if (options_.progress) options_.progress(progress);
  }

  /// Whose posts can be found within the budget.
  [[nodiscard]] std::int64_t most_cells() const {
    if (!options_.budget_seconds) return grid_.cells();
    const WorkOfPosts work = work_of_posts(spec_, grid_, inputs_, !claims_.abstraction.empty());
    const Work most = work_of_seconds(std::max(*options_.budget_seconds, 1.0));
    return work.of_all <= most ? grid_.cells() : std::max<Work>(most / work.of_cell, 1);
  }

  /// A sample and the cells that checks look at whatever the sample is: their posts are needed as well.
  [[nodiscard]] std::vector<std::int64_t> with_paths(const std::vector<std::int64_t>& cells) const {
    std::set<std::int64_t> all(cells.begin(), cells.end());
    for (const std::unique_ptr<AnswerCheck>& check : checks_) {
      for (const std::uint64_t cell : check->more_cells()) {
        if (cell < static_cast<std::uint64_t>(grid_.cells())) all.insert(static_cast<std::int64_t>(cell));
      }
    }
    return {all.begin(), all.end()};
  }

  void compare_sizes() {
    Comparison sizes("sizes");
    std::vector<Finding> others;
    for (const std::unique_ptr<AnswerCheck>& check : checks_) append(others, check->compare_sizes(sizes));
    result_.findings.push_back(sizes.finding());
    append(result_.findings, std::move(others));
  }

  void find_posts() {
    const bool stored = !claims_.abstraction.empty();
    std::vector<std::size_t> enclosed;
    std::vector<std::optional<Finding>> findings(grid_.size());
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const bool jumps = spec_.dynamics.update(i) != nullptr;
      std::optional<PostTable> table = jumps ? update_posts(spec_, grid_, inputs_, i, cells_of_posts_, team_)
                                             : corner_posts(spec_, grid_, inputs_, i, cells_of_posts_, team_);
      if (table && table->exact) {
        if (stored) {
          findings[i] = check_abstraction(grid_, inputs_, i, *table, claims_.abstraction[i], "abstraction");
        }
        tables_.push_back(std::move(*table));
        continue;
      }
      result_.basis = stored ? PostBasis::stored : PostBasis::computed;
      tables_.push_back(stored ? subset_of(claims_.abstraction[i], grid_, inputs_, cells_of_posts_)
                               : analysis().posts(i));
      enclosed.push_back(i);
    }
    const Work most = work_of_seconds(options_.budget_seconds.value_or(VerifyOptions::kDefaultBudget));
    budget_.emplace(most);
    Budget budget = budget_->fraction(1, spec_.abstraction.between_samples ? 2 : 1);
    prove(enclosed, stored ? "abstraction " : "reachable sets ", budget, findings);
    budget_->settle(budget);
    for (std::optional<Finding>& finding : findings) {
      if (finding) result_.findings.push_back(std::move(*finding));
    }
  }

  void prove(const std::vector<std::size_t>& states, const std::string& check, Budget& budget,
             std::vector<std::optional<Finding>>& all) {
    std::vector<PostQuestion> questions;
    for (const std::size_t i : states) {
      questions.push_back({.spec = &spec_,
                           .grid = &grid_,
                           .inputs = &inputs_,
                           .state = i,
                           .claimed = &tables_[i],
                           .cells = &cells_of_posts_,
                           .check = check + grid_[i].name});
    }
    const auto progress = [this](std::size_t done, std::size_t of) {
      report(
          {.stage = "posts", .done = static_cast<std::int64_t>(done), .all = static_cast<std::int64_t>(of)});
    };
    std::vector<std::optional<Finding>> findings = check_outward_posts(questions, budget, progress, team_);
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (!findings[k]) {
        const std::string& name = grid_[states[k]].name;
        borrow(name);
        all[states[k]] = not_independent(check + name, tables_[states[k]]);
        result_.enclosed += all[states[k]]->checked;
        continue;
      }
      result_.enclosed += findings[k]->checked;
      result_.confirmed += findings[k]->checked - findings[k]->unproven - findings[k]->wrong;
      all[states[k]] = std::move(findings[k]);
    }
  }

  /// The finding about posts that the verifier cannot confirm by means of its own.
  [[nodiscard]] static Finding not_independent(std::string check, const PostTable& table) {
    const auto entries = static_cast<std::int64_t>(table.entries.size());
    return {.check = std::move(check),
            .checked = entries,
            .wrong = 0,
            .unproven = entries,
            .examples = {},
            .doubts = {"not checked independently: verify has no second method for these"},
            .note = {}};
  }

  void find_tubes() {
    report({.stage = "tubes"});
    CheckedTubes checked =
        check_tubes(spec_, grid_, inputs_, analysis(), claims_.members("/safe"), *budget_, team_);
    result_.tubes = checked.exact ? PostBasis::exact : PostBasis::computed;
    for (const std::string& state : checked.borrowed) {
      borrow(state);
      for (const PostTable& table : checked.tables) {
        if (grid_[static_cast<std::size_t>(&table - checked.tables.data())].name == state)
          result_.findings.push_back(not_independent("tubes " + state, table));
      }
    }
    append(result_.findings, std::move(checked.findings));
    tube_tables_ = std::move(checked.tables);
    tubes_ = make_tubes(grid_, inputs_, tube_tables_, claims_.members("/safe"), checked.beyond);
  }

  void borrow(const std::string& state) {
    std::vector<std::string>& names = result_.borrowed;
    if (std::find(names.begin(), names.end(), state) == names.end()) names.push_back(state);
  }

  [[nodiscard]] AnalysisTables& analysis() {
    if (!analysis_) analysis_.emplace(spec_, grid_, inputs_, cells_of_posts_, team_);
    return *analysis_;
  }

  void check_answers(const Posts& posts) {
    // No file stores tubes, and the contract does not say how narrow they are.
    const bool stored = result_.basis != PostBasis::computed && !result_.tubes;
    context_.posts_are =
        stored || claims_.same_version ? PostsAre::those_of_the_result : PostsAre::perhaps_others;
    context_.posts = &posts;
    context_.tubes = tubes_ ? &*tubes_ : nullptr;
    std::optional<Budget> budget;
    if (options_.budget_seconds) budget.emplace(work_of_seconds(std::max(*options_.budget_seconds, 1.0)));
    result_.cells_checked = check_cells(
        context_, checks_, sample_, budget ? &*budget : nullptr,
        [this](std::int64_t done, std::int64_t all) { report({.stage = "cells", .done = done, .all = all}); },
        team_);
    if (result_.cells_checked < requested_) {
      result_.findings.push_back({.check = "cells",
                                  .checked = requested_,
                                  .unproven = requested_ - result_.cells_checked,
                                  .examples = {},
                                  .doubts = {"the budget ended"},
                                  .note = {}});
    }
    for (const std::unique_ptr<AnswerCheck>& check : checks_) {
      check->check_all(team_);
      append(result_.findings, check->findings());
    }
  }

  const ProblemSpec& spec_;
  const Claims& claims_;
  const VerifyOptions& options_;
  ThreadTeam& team_;
  UniformGrid grid_;
  InputSpace inputs_;
  CheckContext context_;
  std::vector<std::unique_ptr<AnswerCheck>> checks_;  ///< in the order of the report
  std::optional<Budget> budget_;                      ///< of reachable sets
  std::int64_t requested_ = 0;                        ///< cells that are to be checked
  std::vector<std::int64_t> sample_;                  ///< cells to be checked; all if empty
  std::vector<std::int64_t> cells_of_posts_;          ///< and those whose posts are; all if empty
  std::vector<PostTable> tables_;
  std::vector<PostTable> tube_tables_;
  std::optional<Tubes> tubes_;
  std::optional<AnalysisTables> analysis_;  ///< once it is needed
  Verification result_;
};

}  // namespace

Verdict Verification::verdict() const {
  const auto any = [this](const auto& is) { return std::any_of(findings.begin(), findings.end(), is); };
  if (any([](const Finding& finding) { return finding.wrong > 0; })) return Verdict::wrong;
  return any([](const Finding& finding) { return finding.unproven > 0; }) ? Verdict::not_confirmed
                                                                          : Verdict::holds;
}

Verification verify_claims(const ProblemSpec& spec, const Claims& claims, const VerifyOptions& options,
                           ThreadTeam& team) {
  REQUIRES(!options.full || (!options.sample && !options.budget_seconds));
  return Verifier(spec, claims, options, team).run();
}

}  // namespace coordreq
