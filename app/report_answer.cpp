#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "answers/plan.hpp"
#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/reports.hpp"
#include "app/text.hpp"
#include "base/requires.hpp"
#include "export/report_page.hpp"
#include "results/read_info.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// "0.28 s (28 steps)": time first, for people who do not think in steps.
std::string time_text(std::int64_t steps, const ResultsReader& results) {
  const std::string count = fmt::format("{} step{}", grouped(steps), steps == 1 ? "" : "s");
  const std::string& unit = results.spec().dynamics.unit;
  if (unit.empty()) return count;
  return fmt::format("{:.6g} {} ({})", static_cast<double>(steps) * results.attributes().period,
                     html_line(unit), count);
}

/// The sentences about one partition, by one policy.
class PartitionAnswer {
 public:
  /// @param stored sizes of the policy's layers @param is_only there is no other policy
  PartitionAnswer(const ResultsReader& results, const StoredPartition& stored, const AnswerPolicy& policy,
                  std::int64_t best_cell, bool is_only)
      : results_(results), stored_(stored), policy_(policy), best_cell_(best_cell) {
    if (!is_only) how_ = " " + (is_delay() ? "by independent choice" : policy.headline);
  }

  /// Whether there is no silence to speak of.
  [[nodiscard]] bool is_joint() const { return is_delay() && stored_.classes.size() == 1; }

  /// For how long they may be silent.
  [[nodiscard]] std::string headline() const {
    const std::int64_t last = static_cast<std::int64_t>(stored_.layer_sizes.size()) - 1;
    if (stored_.truncated()) {
      return fmt::format(
          "From {} of the states {} may be silent for {}{}, perhaps longer: the analysis stopped there.",
          share_text(stored_.layer_sizes.back(), whole()), who(), time_text(last, results_), how_);
    }
    if (is_joint()) return "All agents coordinate within every step, so there is no silence to tolerate.";
    if (unbounded() == 0 && last <= 1)
      return fmt::format("From no state may {} be silent{}, not even for one step.", who(), how_);
    if (last == 0 && how_.empty()) return capital(who()) + " never need to talk to each other.";
    const std::string length = last < 1 ? "" : time_text(last - 1, results_);
    if (unbounded() == 0)
      return fmt::format("{} may be silent for <strong>{}</strong>{} from the best state{}.", capital(who()),
                         length, how_, best_state());
    const std::string from =
        share_text(unbounded(), whole()) + " of the states" + (last < 2 ? best_state("e.g. ") : "");
    const std::string always =
        how_.empty()
            ? fmt::format("From {} {} never need to talk to each other", from, who())
            : fmt::format("From {} {} may be silent <strong>indefinitely</strong>{}", from, who(), how_);
    if (last == 0) return always + ".";
    if (last == 1) return always + "; from the others not even for one step.";
    return fmt::format("{}; from the best of the others{} they may be silent for <strong>{}</strong>.",
                       always, best_state(), length);
  }

  /// Where silence is no choice; empty if that is not known or nothing to say.
  [[nodiscard]] std::string at_once() const {
    if (is_joint() || !is_delay()) return "";
    const std::int64_t delay = results_.attributes().connection_delay;
    const std::optional<std::uint64_t> bearing = layer_size(delay + 1);
    if (!bearing) return "";
    const std::uint64_t count = kept() - *bearing;
    const std::string share = count == 0        ? "None"
                              : count == kept() ? "All"
                                                : capital(share_text(count, kept()));
    if (delay == 0) {
      return fmt::format("{} of the states that can be kept safe need{} contact at once.", share,
                         count == 0 ? "s" : "");
    }
    return fmt::format(
        "A connection takes {} to establish: in {} of the states that can be kept safe it must be "
        "requested at once, or exist already.",
        time_text(delay, results_),
        count == 0        ? "none"
        : count == kept() ? "all"
                          : share_text(count, kept()));
  }

  /// The silence that most, half and few of the states tolerate.
  [[nodiscard]] std::string shares() const {
    if (is_joint() || stored_.layer_sizes.size() < 2) return "";
    std::string rows;
    const auto add = [&rows](const std::string& share, const std::string& length) {
      rows += fmt::format("<tr><th scope=\"row\">{} of the states</th><td>{}</td></tr>\n", share, length);
    };
    const std::uint64_t any = stored_.layer_sizes[1];
    if (any == 0) return "";
    if (!is_share(any, 90)) add(share_text(any, whole()), "for at least " + time_text(1, results_));
    for (const int percent : {90, 50, 10, 1})
      if (is_share(any, percent)) add(fmt::format("{} %", percent), bearable(percent));
    return "<table><thead><tr><th scope=\"col\">Share</th><th scope=\"col\">may be "
           "silent</th></tr></thead><tbody>\n" +
           rows + "</tbody></table>\n";
  }

  /// "the agents", or their groups if some go on coordinating.
  [[nodiscard]] std::string who() const {
    const auto joint = [](const std::string& name) { return name.find('+') != std::string::npos; };
    if (std::none_of(stored_.classes.begin(), stored_.classes.end(), joint)) return "the agents";
    std::string text = "the groups ";
    for (std::size_t c = 0; c < stored_.classes.size(); ++c) {
      text += c == 0 ? "" : c + 1 == stored_.classes.size() ? " and " : ", ";
      text += "<em>" + html_line(stored_.classes[c]) + "</em>";
    }
    return text;
  }

 private:
  [[nodiscard]] std::uint64_t kept() const { return stored_.layer_sizes.front(); }
  /// The states that shares in headlines are of: those of K, or of S where the policy is about these.
  [[nodiscard]] std::uint64_t whole() const {
    return policy_.is_anywhere ? results_.attributes().safe_cells : results_.attributes().invariant_cells;
  }
  [[nodiscard]] bool is_delay() const { return policy_.name.empty(); }
  [[nodiscard]] std::uint64_t unbounded() const {
    return stored_.truncated() ? 0 : stored_.layer_sizes.back();
  }

  /// |Z_k|; nothing if the analysis stopped before.
  [[nodiscard]] std::optional<std::uint64_t> layer_size(std::int64_t k) const {
    const auto index = static_cast<std::size_t>(k);
    if (index < stored_.layer_sizes.size()) return stored_.layer_sizes[index];
    if (stored_.truncated()) return std::nullopt;
    return stored_.layer_sizes.back();
  }

  /// Whether so many states are so much of K.
  [[nodiscard]] bool is_share(std::uint64_t size, int percent) const {
    return size * 100 >= whole() * static_cast<std::uint64_t>(percent);
  }

  /// @pre so many tolerate a step
  [[nodiscard]] std::string bearable(int percent) const {
    REQUIRES(stored_.layer_sizes.size() > 1 && is_share(stored_.layer_sizes[1], percent));
    const auto enough = [&](std::uint64_t size) { return is_share(size, percent); };
    const auto& sizes = stored_.layer_sizes;
    const auto end = std::partition_point(sizes.begin(), sizes.end(), enough);
    if (end == sizes.end() && !stored_.truncated()) return "indefinitely";
    return "for at least " + time_text(end - sizes.begin() - 1, results_);
  }

  [[nodiscard]] std::string best_state(const char* before = "") const {
    if (best_cell_ < 0) return "";
    std::string text;
    const UniformGrid& grid = results_.grid();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const std::string& unit = results_.spec().states[i].unit;
      text += fmt::format("{}{} = {:.6g}{}", text.empty() ? "" : ", ", html_line(grid[i].name),
                          nearest_double(grid[i].point(grid.index(best_cell_, i))),
                          unit.empty() ? "" : " " + html_line(unit));
    }
    return fmt::format(" <span class=\"note\">({}{})</span>", before, text);
  }

  const ResultsReader& results_;
  const StoredPartition& stored_;
  const AnswerPolicy& policy_;
  std::int64_t best_cell_;
  std::string how_;  ///< after "silent", with a blank before
};

/// The sentences about all partitions, by all policies that answer the question.
class Answers {
 public:
  Answers(const ResultsReader& results, const ReportData& data)
      : results_(results), data_(data), policies_(headline_policies(results.spec())) {
    for (const AnswerPolicy& policy : policies_)
      sizes_.push_back(read_partition_values(results.spec(), results, policy.kind->prefix()));
  }

  /// What the spec asks for, large; the others below.
  [[nodiscard]] std::string in_full() const {
    std::string html;
    for (std::size_t p = 0; p < results_.partitions().size(); ++p) {
      const PartitionAnswer answer = answer_of(p, 0);
      html += "<div class=\"answer\">\n";
      if (results_.partitions().size() > 1)
        html += fmt::format("<h3>Partition {}</h3>\n", html_line(results_.partitions()[p].name));
      html += fmt::format("<p class=\"headline\">{}</p>\n", answer.headline());
      for (std::size_t i = 1; i < policies_.size(); ++i)
        html += "<p>" + answer_of(p, i).headline() + "</p>\n";
      if (const std::string more = answer.at_once(); !more.empty()) html += "<p>" + more + "</p>\n";
      html += answer.shares() + "</div>\n";
    }
    return html;
  }

  /// With many partitions only those with pictures are not folded.
  [[nodiscard]] std::string as_table() const {
    std::vector<std::string> displayed, others;
    for (std::size_t p = 0; p < results_.partitions().size(); ++p) {
      const PartitionAnswer answer = answer_of(p, 0);
      (has_picture(p) ? displayed : others)
          .push_back(
              html_row({html_line(results_.partitions()[p].name), answer.headline(), answer.at_once()}));
    }
    const std::size_t open = displayed.size();
    displayed.insert(displayed.end(), others.begin(), others.end());
    return html_long_table({"Partition", "Silence", "Contact"}, displayed, "roomy", open);
  }

 private:
  [[nodiscard]] bool has_picture(std::size_t p) const {
    return std::find(data_.partitions.begin(), data_.partitions.end(), p) != data_.partitions.end();
  }

  [[nodiscard]] PartitionAnswer answer_of(std::size_t p, std::size_t i) const {
    const StoredPartition& sizes = sizes_[i][p];
    const std::int64_t best =
        has_picture(p) ? best_cell(results_, policies_[i], p, sizes) : -1;  // else not looked for
    return {results_, sizes, policies_[i], best, policies_.size() == 1};
  }

  const ResultsReader& results_;
  const ReportData& data_;
  std::vector<AnswerPolicy> policies_;
  std::vector<std::vector<StoredPartition>> sizes_;  ///< [policy][partition]
};

std::string partition_answers(const ResultsReader& results, const ReportData& data) {
  const StoredAttributes& attributes = results.attributes();
  const auto only = [](const char* text) {
    return fmt::format("<div class=\"answer\"><p class=\"headline\">{}</p></div>\n", text);
  };
  if (attributes.safe_cells == 0) return only("No state is safe.");
  if (attributes.invariant_cells == 0) {
    return only(results.spec().controller.synthesis == Synthesis::given
                    ? "There is no state from which every allowed action keeps the system safe."
                    : "No state can be kept safe, even if all agents always coordinate.");
  }
  const Answers answers(results, data);
  return results.partitions().size() > kMostPartitionsInFull ? answers.as_table() : answers.in_full();
}

/// The meaning of the numbers, and their limits.
std::string fine_print(const ResultsReader& results) {
  const StoredAttributes& attributes = results.attributes();
  const auto cells = static_cast<std::uint64_t>(results.grid().cells());
  return fmt::format(
      "<p>The grid divides the domain into {} cells, and a <em>state</em> here is such a cell. {} of "
      "them are safe; from {} of these "
      "the system can be kept safe indefinitely if all agents coordinate.</p>\n"
      "<p class=\"note\">Guarantee {}; for every disturbance, and whatever admissible actions the agents "
      "choose independently.</p>\n",
      grouped(cells), grouped(attributes.safe_cells), grouped(attributes.invariant_cells),
      html_line(guarantee_of_file(attributes.guarantee, results.spec())));
}

}  // namespace

std::string report_answer(const ResultsReader& results, const ReportData& data) {
  return "<section aria-labelledby=\"answer-title\">\n<h2 id=\"answer-title\">How long may the agents be "
         "silent?</h2>\n" +
         partition_answers(results, data) + fine_print(results) + "</section>\n";
}

std::string report_footer(const ResultsReader& results) {
  const StoredAttributes& attributes = results.attributes();
  return fmt::format(
      "<footer class=\"note\"><p>Analysed by coordreq {} ({}). SHA-256 of the spec: "
      "<code>{}</code>.</p></footer>\n",
      html_line(attributes.coordreq_version), html_line(attributes.git_sha1),
      html_line(attributes.spec_sha256));
}

}  // namespace coordreq
