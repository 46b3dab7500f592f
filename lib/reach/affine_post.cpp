#include "reach/affine_post.hpp"

namespace coordreq {

IndexForm AffinePost::end_form(const SampledRow& row, bool upper, const Rational& more) const {
  const GridDimension& target = grid[state];
  std::vector<Rational> factors;
  std::vector<std::int64_t> counts;
  Rational offset = (upper ? row.upper : row.lower) - target.first;
  for (std::size_t j = 0; j < moving.size(); ++j) {
    const GridDimension& source = grid[static_cast<std::size_t>(moving[j])];
    const Rational& m = row.coefficient[j];
    const Rational spread = abs(m) * (source.radius() + source.measurement_error);
    offset += m * source.first + (upper ? spread : Rational(-spread));
    factors.push_back(m * source.step / target.step);
    counts.push_back(source.count);
  }
  return IndexForm(factors, offset / target.step + more, counts);
}

Piece AffinePost::from_pieces(const SampledRow& row, const std::vector<Piece>& pieces) const {
  Piece values{row.lower, row.upper};
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    const Rational& m = row.coefficient[j];
    values.lower += m * (m > 0 ? pieces[j].lower : pieces[j].upper);
    values.upper += m * (m > 0 ? pieces[j].upper : pieces[j].lower);
  }
  return values;
}

}  // namespace coordreq
