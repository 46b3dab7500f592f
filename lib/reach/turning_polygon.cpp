#include "reach/turning_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using Vector = TurningPolygon::Vector;

/// Far more than what sums of some forty terms are rounded by, in parts of their magnitudes.
constexpr double kRounding = 1e-12;
constexpr double kLeast = 1e-280;
/// Sides whose normals differ less are one side.
constexpr double kLeastTurn = 1e-4;
constexpr double kWidestTurn = 0.05;  ///< sine of what is left to half a turn between neighbours
constexpr std::size_t kMostSides = 40;
constexpr double kMoreTolerance = 2.0;
constexpr int kToleranceTries = 40;
constexpr int kVertexTries = 12;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1];
}

double cross(const Vector& a, const Vector& b) {
  return a[0] * b[1] - a[1] * b[0];
}

Vector plus(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1]};
}

/// |a| b, by components.
double magnitude(const Vector& a, const Vector& b) {
  return std::fabs(a[0]) * b[0] + std::fabs(a[1]) * b[1];
}

Vector speed_at(const TurningPolygon::Corner& corner, const Vector& x) {
  return {dot(corner.matrix[0], x) + corner.constant[0], dot(corner.matrix[1], x) + corner.constant[1]};
}

Vector transposed(const TurningPolygon::Corner& corner, const Vector& p) {
  return {corner.matrix[0][0] * p[0] + corner.matrix[1][0] * p[1],
          corner.matrix[0][1] * p[0] + corner.matrix[1][1] * p[1]};
}

/// Where the lines p x = a and q x = b meet.
Vector meeting(const Vector& p, double a, const Vector& q, double b) {
  const double area = cross(p, q);
  return {(a * q[1] - b * p[1]) / area, (p[0] * b - q[0] * a) / area};
}

/// The corners of the smallest convex polygon around sorted points, counterclockwise.
template <class Point>
std::vector<Point> convex_hull(const std::vector<Point>& sorted) {
  std::vector<Point> result;
  const auto add_half = [&](auto from, auto to) {
    const std::size_t begin = result.size();
    for (; from != to; ++from) {
      while (result.size() >= begin + 2) {
        const Vector& last = result[result.size() - 2].place;
        if (cross(plus(result.back().place, -1.0, last), plus(from->place, -1.0, last)) > 0.0) break;
        result.pop_back();
      }
      result.push_back(*from);
    }
    result.pop_back();
  };
  add_half(sorted.begin(), sorted.end());
  add_half(sorted.rbegin(), sorted.rend());
  return result;
}

/// p x >= offset for sure.
bool reaches(const Vector& p, const Vector& x, double offset) {
  return outward::add_down(outward::multiply_down(p[0], x[0]), outward::multiply_down(p[1], x[1])) >= offset;
}

}  // namespace

void TurningPolygon::begin(std::span<const Corner> corners, const Bounds& bounds,
                           const std::array<Interval, 2>& start, const Vector& tolerance) {
  corners_.assign(corners.begin(), corners.end());
  bounds_ = bounds;
  tolerance_ = tolerance;
  const auto& [x, y] = start;
  pushes_.resize(corners_.size());
  vertices_ = {{x.lower, y.lower}, {x.upper, y.lower}, {x.upper, y.upper}, {x.lower, y.upper}};
}

bool TurningPolygon::step(double h, const Vector& change) {
  find_speeds();
  find_sides(h);
  leave_out_sides();
  for (Side& side : sides_) move(side, h, change);
  return find_vertices();
}

std::array<Interval, 2> TurningPolygon::box() const {
  std::array<Interval, 2> result;
  for (const std::size_t i : {0U, 1U}) {
    const auto less = [i](const Vector& a, const Vector& b) { return a[i] < b[i]; };
    const auto [least, most] = std::minmax_element(vertices_.begin(), vertices_.end(), less);
    result[i] = {(*least)[i], (*most)[i]};
  }
  return result;
}

void TurningPolygon::find_speeds() {
  size_ = bounds_.size;
  speed_ = bounds_.speed;
  speeds_.clear();
  for (const Vector& x : vertices_) {
    for (const Corner& corner : corners_) speeds_.push_back(speed_at(corner, x));
    for (const std::size_t i : {0U, 1U}) {
      size_[i] = std::max(size_[i], std::fabs(x[i]));
      for (std::size_t c = 0; c < corners_.size(); ++c)
        speed_[i] = std::max(speed_[i], std::fabs(speeds_[speeds_.size() - 1 - c][i]));
    }
  }
}

/// Those of the hull of where vertices go, each under one corner; which ones are taken is no matter of proof.
void TurningPolygon::find_sides(double h) {
  images_.clear();
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const Vector& v = speeds_[k * corners_.size() + c];
      const Corner& corner = corners_[c];
      const Vector bend{dot(corner.matrix[0], v), dot(corner.matrix[1], v)};
      images_.push_back({plus(plus(vertices_[k], h, v), 0.5 * h * h, bend), c});
    }
  }
  std::sort(images_.begin(), images_.end());
  const auto is_same = [](const Image& a, const Image& b) { return a.place == b.place; };
  images_.erase(std::unique(images_.begin(), images_.end(), is_same), images_.end());
  sides_.clear();
  if (images_.size() < 3) return;
  const std::vector<Image> hull = convex_hull(images_);
  for (std::size_t k = 0; k < hull.size() && hull.size() >= 3; ++k) {
    const Vector way = plus(hull[(k + 1) % hull.size()].place, -1.0, hull[k].place);
    const double length = std::hypot(way[0], way[1]);
    const Vector normal{way[1] / length, -way[0] / length};
    sides_.push_back({normal, dot(normal, hull[k].place), hull[k].corner});
  }
}

void TurningPolygon::leave_out_sides() {
  double factor = 1.0;
  for (int n = 0; n < kToleranceTries && (n == 0 || sides_.size() > kMostSides); ++n) {
    while (leave_out_some(factor)) {
    }
    factor *= kMoreTolerance;
  }
  if (sides_.size() >= 3) return;
  sides_ = {{{1.0, 0.0}}, {{0.0, 1.0}}, {{-1.0, 0.0}}, {{0.0, -1.0}}};
}

/// Never two neighbours at once. @returns whether there were any
bool TurningPolygon::leave_out_some(double factor) {
  const std::size_t count = sides_.size();
  std::vector<bool> left_out(count);
  bool any = false;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t before = (k + count - 1) % count;
    const std::size_t after = (k + 1) % count;
    if (left_out[before] || left_out[after] || !can_meet(before, k, after)) continue;
    const bool turns = cross(sides_[before].normal, sides_[k].normal) > kLeastTurn;
    left_out[k] = !turns || overshoot(before, k, after) < factor * magnitude(sides_[k].normal, tolerance_);
    any = any || left_out[k];
  }
  if (!any) return false;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!left_out[k]) sides_[kept++] = sides_[k];
  }
  sides_.resize(kept);
  return true;
}

/// Whether the neighbours of a side have a corner beyond it, not too far away.
bool TurningPolygon::can_meet(std::size_t before, std::size_t side, std::size_t after) const {
  const Vector& p = sides_[before].normal;
  const Vector& q = sides_[after].normal;
  const bool turn_little = dot(p, sides_[side].normal) >= 0.0 && dot(sides_[side].normal, q) >= 0.0;
  return turn_little && cross(p, q) > (dot(p, q) >= 0.0 ? 0.0 : kWidestTurn);
}

/// How far the polygon would reach beyond a side that is left out.
double TurningPolygon::overshoot(std::size_t before, std::size_t side, std::size_t after) const {
  const Side& a = sides_[before];
  const Side& b = sides_[after];
  return dot(sides_[side].normal, meeting(a.normal, a.offset, b.normal, b.offset)) - sides_[side].offset;
}

/// Finds a bound of normal x after the step.
void TurningPolygon::move(Side& side, double h, const Vector& change) {
  find_turn(side, h);
  double bend = 0.0;
  for (const Vector& g : move_.gradient) bend = std::max(bend, magnitude(g, change));
  bend = h * h * h * (bend / 6.0 + magnitude(move_.turn, change) / 3.0);
  side.offset = largest() + (1.0 + kRounding) * bend + rounding();
}

/// The normal at the start of the step, from which it turns as solutions do that go farthest.
void TurningPolygon::find_turn(const Side& side, double h) {
  const Vector& normal = side.normal;
  const Corner& fastest = corners_[side.corner];
  const Vector along = transposed(fastest, normal);
  move_.turn = plus({-along[0], -along[1]}, -0.5 * h, transposed(fastest, along));
  move_.start = plus(normal, -h, move_.turn);
  move_.h = h;
  move_.gradient.clear();
  move_.most_gradient = 0.0;
  for (const Corner& corner : corners_) {
    move_.gradient.push_back(plus(move_.turn, 1.0, transposed(corner, move_.start)));
    move_.most_gradient = std::max(move_.most_gradient, magnitude(move_.gradient.back(), speed_));
  }
}

/// Over the vertices.
double TurningPolygon::largest() {
  std::size_t first = 0;
  for (std::size_t k = 1; k < vertices_.size(); ++k) {
    if (dot(move_.start, vertices_[k]) > dot(move_.start, vertices_[first])) first = k;
  }
  double result = value_at(first, -HUGE_VAL);
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    if (k != first) result = std::max(result, value_at(k, result));
  }
  return result;
}

/// @param known what need not be told from less
double TurningPolygon::value_at(std::size_t vertex, double known) {
  const std::size_t count = corners_.size();
  const Vector* const speeds = &speeds_[vertex * count];
  const double h = move_.h;
  const double base = dot(move_.start, vertices_[vertex]) + h * dot(move_.turn, vertices_[vertex]);
  double fastest = -HUGE_VAL;
  for (std::size_t c = 0; c < count; ++c) {
    pushes_[c] = dot(move_.start, speeds[c]);
    fastest = std::max(fastest, pushes_[c]);
  }
  if (base + h * (fastest + 0.5 * h * (move_.most_gradient + magnitude(move_.turn, speed_))) < known)
    return known;
  double largest = -HUGE_VAL;
  for (std::size_t c = 0; c < count; ++c) {
    const double of_c = pushes_[c] + h * dot(move_.turn, speeds[c]);
    for (std::size_t d = 0; d < count; ++d)
      largest = std::max(largest, of_c + pushes_[d] + h * dot(move_.gradient[c], speeds[d]));
  }
  return base + 0.5 * h * largest;
}

/// What all in largest() may be wrong by.
double TurningPolygon::rounding() const {
  const double h = move_.h;
  const double start = magnitude(move_.start, size_) + h * magnitude(move_.start, speed_);
  const double turn = h * magnitude(move_.turn, size_) + h * h * magnitude(move_.turn, speed_);
  const double change = h * h * (magnitude(move_.start, bounds_.change) + move_.most_gradient);
  return kRounding * (start + turn + change) + kLeast;
}

/// Every direction lies between two normals that follow one another, so that what is on the inner side of all
/// sides is in the hull of the vertices, even where a side is too far out to matter.
bool TurningPolygon::find_vertices() {
  vertices_.clear();
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    Vector vertex;
    // Vertex k is between sides k and k + 1.
    if (!find_vertex(sides_[k], sides_[(k + 1) % sides_.size()], vertex)) return false;
    vertices_.push_back(vertex);
  }
  return true;
}

bool TurningPolygon::find_vertex(const Side& a, const Side& b, Vector& vertex) const {
  if (!(cross(a.normal, b.normal) > 0.5 * kLeastTurn)) return false;
  double more = kRounding * std::max(magnitude(a.normal, size_), magnitude(b.normal, size_)) + kLeast;
  for (int n = 0; n < kVertexTries; ++n) {
    vertex = meeting(a.normal, a.offset + more, b.normal, b.offset + more);
    if (!std::isfinite(vertex[0]) || !std::isfinite(vertex[1])) return false;
    if (reaches(a.normal, vertex, a.offset) && reaches(b.normal, vertex, b.offset)) return true;
    more *= 4.0;
  }
  return false;
}

}  // namespace coordreq
