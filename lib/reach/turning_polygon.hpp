#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "numeric/interval.hpp"

namespace coordreq {

/// A convex polygon of all states that x' = A x + b can reach in the plane, where A and b change in time as
/// they like between those of a few corners (and their weighted means).
///
/// In a step of length h from x0, with p(s) = p + s q for the normal of a side and one of the corners at each
/// time,
///
///     p(h) x(h) <= p x0 + h max over corners c, d of { (a(c) + a(d)) / 2 + h/2 (g(c) f(x0, d) + q f(x0, c))
///     }
///                  + h^3 (|g| / 6 + |q| / 3) max |A f|,      a = q x0 + p f(x0),   g = q + A^T p:
///
/// the mean over pairs of times of a corner d before and a corner c after. That is largest at a vertex.
/// Normals turn as solutions along the side do, q = -A^T p, so that g vanishes for what pushes it most. Which
/// sides there are is seen from where the vertices go; those that matter little are left out.
///
/// Over-approximates; doubles, with what they may have been rounded by added. Scratch memory for one thread.
class TurningPolygon {
 public:
  using Vector = std::array<double, 2>;
  struct Corner {
    std::array<Vector, 2> matrix;  ///< by rows
    Vector constant;
  };
  /// Of all states that solutions take, and all corners.
  struct Bounds {
    Vector size;    ///< largest magnitudes of the states
    Vector speed;   ///< of A x + b
    Vector change;  ///< of A' (A x + b), A' of any corner
  };

  /// @pre unchecked: coefficients are off by no more than 1e-14 of what is in `bounds`.
  /// @param tolerance what a side that is left out may matter, in each state
  void begin(std::span<const Corner> corners, const Bounds& bounds, const std::array<Interval, 2>& start,
             const Vector& tolerance);

  /// Goes on by a time h.
  /// @param change as in Bounds, during this step
  /// @returns whether it could; if not, begin again
  bool step(double h, const Vector& change);

  /// The smallest box around it.
  [[nodiscard]] std::array<Interval, 2> box() const;

 private:
  struct Side {
    Vector normal;
    double offset = 0.0;     ///< normal x <= offset
    std::size_t corner = 0;  ///< that pushes it most
  };
  /// Where a vertex goes under a corner.
  struct Image {
    Vector place;
    std::size_t corner = 0;

    friend auto operator<=>(const Image&, const Image&) = default;
  };
  struct Move {
    Vector start;  ///< the normal before the step
    Vector turn;
    double h;
    std::vector<Vector> gradient;  ///< of what the side is pushed by, for each corner
    double most_gradient;          ///< of its products with speeds
  };

  void find_speeds();
  void find_sides(double h);
  void leave_out_sides();
  bool leave_out_some(double factor);
  [[nodiscard]] bool can_meet(std::size_t before, std::size_t side, std::size_t after) const;
  [[nodiscard]] double overshoot(std::size_t before, std::size_t side, std::size_t after) const;
  void move(Side& side, double h, const Vector& change);
  void find_turn(const Side& side, double h);
  [[nodiscard]] double largest();
  [[nodiscard]] double value_at(std::size_t vertex, double known);
  [[nodiscard]] double rounding() const;
  bool find_vertices();
  [[nodiscard]] bool find_vertex(const Side& a, const Side& b, Vector& vertex) const;

  std::vector<Corner> corners_;
  Bounds bounds_{};
  Vector tolerance_{};
  Vector size_{};  ///< as in bounds_, of the vertices too
  Vector speed_{};
  std::vector<Vector> vertices_;  ///< counterclockwise
  std::vector<Vector> speeds_;    ///< at each vertex, for each corner
  std::vector<double> pushes_;    ///< of one vertex, for each corner
  std::vector<Image> images_;
  std::vector<Side> sides_;
  Move move_{};
};

}  // namespace coordreq
