#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "model/uniform_grid.hpp"
#include "verify/budget.hpp"
#include "verify/next_value.hpp"
#include "verify/sampled_map.hpp"

namespace coordreq {

/// The range of cells that the next value of a state is said to be in.
struct PostClaim {
  std::size_t target = 0;  ///< which of the states
  IndexRange range;
};

/// The result of proving a claim.
enum class PostVerdict : std::uint8_t {
  holds,  ///< it has every value that can come next
  wrong,  ///< some value that does come next is not in it
  open,   ///< neither
};
struct PostProof {
  PostVerdict verdict = PostVerdict::holds;
  std::string why;          ///< where it ends, and from where; or why nothing is proven
  bool is_cut_off = false;  ///< open, and there was no work left to go on
};

/// A subbox, by the cuts that lead to it, and the claims that are open on it.
struct OpenSubbox {
  std::vector<std::uint16_t> cuts;    ///< in the code of PostProver
  std::vector<std::uint32_t> claims;  ///< by number
};

/// How far to go for one range: pieces of its cell, and the work for each of them.
struct PostEffort {
  int most_boxes = 1;
  Effort effort;
};

/// States that the same things have an influence on, so that one enclosure serves them all.
struct PostGroup {
  std::vector<std::size_t> states;
  Influences influences;
  /// The next value is the present one and something that does not depend on it: claims are about the cell
  /// with index 0. Only of one state alone.
  bool shifts = false;
};

/// Proves claimed ranges of next values. One object a thread.
class PostProver {
 public:
  /// @pre unchecked: all outlive this object.
  PostProver(const SystemSpec& spec, const UniformGrid& grid, const PostGroup& group);

  /// @param box where the present state can be
  /// @param subboxes of the box on which claims are to be proven; is set to those on which they are still
  /// open.
  ///   A part without cuts is the whole box
  /// @param most work after which nothing is cut
  /// @param beyond work after that, for pieces that are not yet proven; then the rest is left
  /// @returns one a claim
  [[nodiscard]] std::vector<PostProof> prove(const SpanBox& box, const std::vector<PostClaim>& claims,
                                             std::vector<OpenSubbox>& subboxes, const PostEffort& effort,
                                             Work most, Work beyond);
  /// Done so far.
  [[nodiscard]] Work work() const { return next_->work(); }

 private:
  struct Piece {
    SpanBox box;
    OpenSubbox subbox;
  };
  /// The part of the span of a variable that a cut leaves.
  enum class Cut : std::uint8_t { lower_face, upper_face, lower_half, upper_half };

  void cut_off(Piece& piece, std::uint32_t slot, Cut cut) const;
  [[nodiscard]] Piece piece_of(const SpanBox& box, OpenSubbox subbox) const;
  [[nodiscard]] std::vector<Piece> cut_pieces(const Piece& piece, std::uint32_t cut) const;

  [[nodiscard]] std::optional<std::uint32_t> prove_piece(Piece& piece, const std::vector<PostClaim>& claims,
                                                         const Effort& effort,
                                                         std::vector<PostProof>& proofs);
  [[nodiscard]] PostProof prove_claim(const PostClaim& claim, const Extremes& extremes) const;
  [[nodiscard]] bool is_claimed(const PostClaim& claim, const Arb& lower, const Arb& upper) const;
  [[nodiscard]] IndexRange cells_of(std::size_t target, const Arb& lower, const Arb& upper) const;
  [[nodiscard]] std::optional<std::string> witness(const PostClaim& claim, const Extreme& extreme) const;
  [[nodiscard]] bool misses(const PostClaim& claim, const Rational& lower, const Rational& upper) const;
  [[nodiscard]] std::optional<std::uint32_t> widest(const SpanBox& box, std::vector<double> excess) const;
  [[nodiscard]] const GridDimension& target(std::size_t i) const { return grid_[group_.states[i]]; }

  const SystemSpec& spec_;
  const UniformGrid& grid_;
  const PostGroup& group_;
  std::unique_ptr<NextValue> next_;
  std::vector<std::size_t> values_;  ///< [target]: which of those of next_
};

}  // namespace coordreq
