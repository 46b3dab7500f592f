#include "verify/verify.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "reach/build_abstraction.hpp"
#include "verify/check_abstraction.hpp"
#include "verify/check_cells.hpp"
#include "verify/check_coalition.hpp"
#include "verify/check_network.hpp"
#include "verify/check_requirements.hpp"
#include "verify/check_summary.hpp"
#include "verify/check_tubes.hpp"
#include "verify/outward_posts.hpp"

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
        inputs_(make_input_space(spec)) {}

  Verification run() {
    result_.name = spec_.name;
    result_.cells = grid_.cells();
    append(result_.findings, check_summary(spec_, claims_));
    report({.stage = "posts"});
    find_posts();
    if (spec_.abstraction.between_samples) find_tubes();
    append(result_.findings, check_cells_against(make_posts(grid_, inputs_, tables_)));
    if (spec_.coordination.horizon) append(result_.findings, check_coalition(spec_, grid_, claims_, team_));
    return std::move(result_);
  }

 private:
  void report(const VerifyProgress& progress) const {
    if (options_.progress) options_.progress(progress);
  }

  void find_posts() {
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const bool stored = !claims_.abstraction.empty();
      std::optional<PostTable> own = corner_posts(spec_, grid_, inputs_, i, team_);
      if (own && own->exact) {
        if (stored)
          result_.findings.push_back(
              check_abstraction(grid_[i], *own, claims_.abstraction[i], "abstraction"));
        tables_.push_back(std::move(*own));
        continue;
      }
      result_.basis = stored ? PostBasis::stored : PostBasis::computed;
      PostTable claimed = stored ? claims_.abstraction[i] : table_of_analysis(i);
      if (!own) own = outward_posts(spec_, grid_, inputs_, i, claimed, team_);
      if (!own) {
        borrow(grid_[i].name);
        own = table_of_analysis(i);
      }
      result_.findings.push_back(
          check_abstraction(grid_[i], *own, claimed, stored ? "abstraction" : "reachable sets"));
      tables_.push_back(std::move(claimed));
    }
  }

  void find_tubes() {
    report({.stage = "tubes"});
    CheckedTubes checked = check_tubes(spec_, analysis(), claims_.safe, team_);
    result_.tubes = checked.exact ? PostBasis::exact : PostBasis::computed;
    for (const std::string& state : checked.borrowed) borrow(state);
    append(result_.findings, std::move(checked.findings));
    tube_tables_ = std::move(checked.tables);
    tubes_ = make_tubes(grid_, inputs_, tube_tables_, claims_.safe, checked.beyond);
  }

  void borrow(const std::string& state) {
    std::vector<std::string>& names = result_.borrowed;
    if (std::find(names.begin(), names.end(), state) == names.end()) names.push_back(state);
  }

  [[nodiscard]] const Abstraction& analysis() {
    if (!analysis_) analysis_ = build_abstraction(spec_, team_);
    return *analysis_;
  }

  [[nodiscard]] PostTable table_of_analysis(std::size_t state) {
    PostTable table = empty_table(grid_, inputs_, influences_on(spec_, state));
    table.exact = false;
    table.entries = written_out(analysis(), state).entries;
    return table;
  }

  std::vector<Finding> check_cells_against(const Posts& posts) {
    // No file stores tubes, and the contract does not say how narrow they are.
    const bool stored = result_.basis != PostBasis::computed && !result_.tubes;
    const bool certain = stored || claims_.same_version;
    CellCheck check{.spec = &spec_,
                    .grid = &grid_,
                    .inputs = &inputs_,
                    .claims = &claims_,
                    .posts = &posts,
                    .tubes = tubes_ ? &*tubes_ : nullptr,
                    .posts_are = certain ? PostsAre::those_of_the_result : PostsAre::perhaps_others};
    result_.cells_checked = grid_.cells();
    if (options_.sample && *options_.sample < grid_.cells()) {
      check.cells = drawn_cells(grid_.cells(), *options_.sample);
      result_.cells_checked = *options_.sample;
    }
    check.progress = [this](std::int64_t done, std::int64_t all) {
      report({.stage = "cells", .done = done, .all = all});
    };
    std::vector<Finding> findings = check_cells(check, team_);
    if (spec_.network) findings.push_back(check_network(check, team_));
    append(findings, check_requirements(check, team_));
    return findings;
  }

  const ProblemSpec& spec_;
  const Claims& claims_;
  const VerifyOptions& options_;
  ThreadTeam& team_;
  UniformGrid grid_;
  InputSpace inputs_;
  std::vector<PostTable> tables_;
  std::vector<PostTable> tube_tables_;
  std::optional<Tubes> tubes_;
  std::optional<Abstraction> analysis_;
  Verification result_;
};

}  // namespace

bool Verification::holds() const {
  return std::all_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.wrong == 0; });
}

Verification verify_claims(const ProblemSpec& spec, const Claims& claims, const VerifyOptions& options,
                           ThreadTeam& team) {
  return Verifier(spec, claims, options, team).run();
}

}  // namespace coordreq
