#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "model/input_class.hpp"
#include "verify/allowed_pairs.hpp"
#include "verify/check_cells.hpp"
#include "verify/check_convention.hpp"
#include "verify/safe_judge.hpp"

namespace coordreq {

/// What all threads share while they check cells.
struct CellTallies {
  explicit CellTallies(const CellCheck& check);

  /// In the order in which they are reported.
  [[nodiscard]] std::vector<Finding> findings() const;

  Tally safe{"S"};
  Tally invariant{"K"};
  Tally collision_time{"collision time"};
  std::deque<Tally> delay, trigger;  ///< by partition
  std::deque<Tally> actions;         ///< by partition
  Tally controller{"controller"};
  ConventionTallies convention;
  std::vector<bool> has_actions;
  bool has_controller = false;
};

/// Checks one cell after the other. One object a thread.
class CellChecker {
 public:
  CellChecker(const CellCheck& check, CellTallies& tallies, SafeMemory& memory);

  void check(std::int64_t cell);

 private:
  struct Partition {
    std::vector<InputClass> classes;
    std::vector<std::vector<std::uint8_t>> projection;  ///< [class][action], of this cell
  };

  void check_safe();
  void check_outside();
  void check_collision_time(std::int32_t expected);
  void check_escape();
  void check_stay();
  void find_admitted();
  void check_controller();
  void check_partition(std::size_t p);
  void project(Partition& partition) const;
  void check_actions(std::size_t p);
  void check_delay(std::size_t p, std::int32_t expected);
  [[nodiscard]] std::int32_t delay_by_definition(std::size_t p);
  [[nodiscard]] bool is_choice(const Partition& partition, std::int64_t u) const;
  [[nodiscard]] std::int64_t wrong_bits(const std::vector<std::uint8_t>& bytes,
                                        const std::vector<std::uint8_t>& expected, bool& fewer) const;

  /// min over the post of u; see PostMinima::least() and forget().
  [[nodiscard]] std::int32_t least(std::int64_t u, const std::vector<std::int32_t>& values,
                                   std::int32_t blocked);
  /// To be called before least() is asked about other values.
  void forget();

  [[nodiscard]] std::string place() const;
  [[nodiscard]] bool sound_only() const { return check_.posts_are == PostsAre::perhaps_others; }
  [[nodiscard]] std::size_t at() const { return static_cast<std::size_t>(cell_); }

  const CellCheck& check_;
  const ProblemSpec& spec_;
  const Claims& claims_;
  CellTallies& tallies_;
  PostMinima posts_;
  std::optional<CellTubes> tubes_;  ///< if the ways between the samples count
  AllowedPairs allowed_;
  SafeJudge judge_;
  std::optional<ConventionChecker> convention_;  ///< if the spec asks for one
  std::vector<Partition> partitions_;
  std::int64_t inputs_;
  std::int64_t cell_ = 0;
  std::vector<std::uint8_t> admitted_;  ///< [u]: in C(x)
  std::vector<std::int32_t> memory_;    ///< of posts_
};

}  // namespace coordreq
