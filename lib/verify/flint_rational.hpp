#pragma once

#include <flint/fmpq.h>

#include "numeric/rational.hpp"

namespace coordreq {

/// A rational number as FLINT's functions take it.
class FlintRational {
 public:
  FlintRational() { fmpq_init(q_); }
  explicit FlintRational(const Rational& value) : FlintRational() { fmpq_set_mpq(q_, value.get_mpq_t()); }
  FlintRational(const FlintRational&) = delete;
  FlintRational& operator=(const FlintRational&) = delete;
  ~FlintRational() { fmpq_clear(q_); }

  [[nodiscard]] fmpq* get() { return q_; }
  [[nodiscard]] Rational value() const {
    Rational result;
    fmpq_get_mpq(result.get_mpq_t(), q_);
    return result;
  }

 private:
  fmpq_t q_;
};

}  // namespace coordreq
