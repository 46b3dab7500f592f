#pragma once

#include "model/odometer.hpp"

namespace coordreq {

/// Odometer under its former name, until all that use it have changed over.
class Counter : public Odometer {
 public:
  using Odometer::Odometer;
  bool next() { return advance(); }
};

}  // namespace coordreq
