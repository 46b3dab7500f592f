#pragma once

#include "verify/next_value.hpp"

namespace coordreq {

/// The next value of a state in discrete time, or of any expression of states and disturbances: the better of
/// its natural range and of its mean value form, which begins at the ends of what is monotone.
class MapExtremes : public NextValue {
 public:
  /// @pre unchecked: `spec` outlives this object.
  MapExtremes(const SystemSpec& spec, const Influences& influences, std::size_t state);

  [[nodiscard]] bool enclose(const SpanBox& box, const Effort& effort) override;
  [[nodiscard]] Extremes extremes(std::size_t value, const Enough& enough) override;
  [[nodiscard]] const std::vector<std::uint32_t>& divisible() const override { return map_.variables(); }
  [[nodiscard]] Work work() const override { return map_.work(); }
  void limit_work(Work most) override { map_.limit_work(most); }
  [[nodiscard]] bool is_spent() const override { return map_.is_spent(); }
  /// True if the value is that of `slot` and something that does not depend on it.
  [[nodiscard]] bool follows(const ArbBox& box, std::uint32_t slot);

 private:
  SeriesField map_;
  SpanBox box_;
  Arb natural_;                             ///< the range over it
  std::optional<std::vector<Arb>> slopes_;  ///< if they were needed
};

/// The extreme of one equation of a vector field over a box.
[[nodiscard]] Extreme extreme_of(SeriesField& field, std::size_t equation, const SpanBox& box,
                                 const std::optional<std::vector<Arb>>& slopes, bool greatest);

}  // namespace coordreq
