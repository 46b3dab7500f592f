#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/input_class.hpp"
#include "verify/claims.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// What all threads share while they check conventions.
struct ConventionTallies {
  explicit ConventionTallies(const Claims& claims)
      : is_claimed(!claims.convention_freedom.empty()), has_actions(!claims.convention.empty()) {}

  void add_findings(std::vector<Finding>& findings) const;

  Tally freedom{"convention"};
  Tally actions{"convention actions"};
  bool is_claimed = false;
  bool has_actions = false;
};

/// Checks the convention of one cell after the other, from C(x) by its definition: from the lowest-numbered
/// joint input on, agents in order add their actions, ascending, as long as the product stays in C(x). One
/// object a thread.
class ConventionChecker {
 public:
  /// REQUIRES: all outlive this object; the claims have the freedom of every agent.
  ConventionChecker(const ProblemSpec& spec, const InputSpace& inputs, const Claims& claims,
                    ConventionTallies& tallies);

  /// @param admitted [joint input]: in C(x); none outside K
  /// @param sound_only C(x) is perhaps larger than that of the analysis: another convention is wrong only
  /// where
  ///   it leaves C(x)
  void check(std::int64_t cell, const std::vector<std::uint8_t>& admitted, bool sound_only,
             const std::function<std::string()>& place);

 private:
  using Sets = std::vector<std::vector<std::uint8_t>>;  ///< [agent][action]

  void find(const std::vector<std::uint8_t>& admitted);
  [[nodiscard]] bool can_add(std::size_t agent, std::size_t action,
                             const std::vector<std::uint8_t>& admitted) const;
  [[nodiscard]] bool is_product_in(const Sets& sets, const std::vector<std::uint8_t>& admitted) const;
  [[nodiscard]] Sets claimed_sets(std::int64_t cell) const;
  void check_actions(std::int64_t cell, const std::vector<std::uint8_t>& admitted, bool sound_only,
                     const std::function<std::string()>& place);
  void check_freedom(std::int64_t cell, const std::vector<std::uint8_t>& admitted, bool sound_only,
                     const std::function<std::string()>& place);

  const ProblemSpec& spec_;
  const Claims& claims_;
  ConventionTallies& tallies_;
  std::vector<InputClass> agents_;
  /// [agent][action]: the joint inputs with it.
  std::vector<std::vector<std::vector<std::int32_t>>> joint_;
  Sets sets_;  ///< of the cell at work
};

}  // namespace coordreq
