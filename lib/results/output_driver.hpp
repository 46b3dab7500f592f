#pragma once

#include <string>

#include "results/hdf5_handle.hpp"

namespace coordreq::hdf5 {

/// A file driver that never reports to the HDF5 library that a write failed, and keeps the reason instead,
/// which the writer has to ask for. The bytes in the file are those of the default driver.
///
/// The library cannot give up a file that it cannot write to: closing it on a full disk frees its memory but
/// keeps its identifier, and the program crashes when it ends. With this driver it always closes, and the
/// caller throws the file away.
///
/// Must outlive the file: the library calls the driver after it has let go of it.
class OutputDriver {
 public:
  OutputDriver();
  OutputDriver(const OutputDriver&) = delete;  // open files point into it
  OutputDriver& operator=(const OutputDriver&) = delete;

  /// Makes the file that is opened with `access` use this driver.
  void use_for(const Handle& access);

  /// errno of the first system call that failed, 0 while all goes well.
  [[nodiscard]] int first_error() const { return first_error_; }
  /// @throws Failure "cannot <what>" if one has failed
  void check_written(const std::string& what) const;

 private:
  Handle id_;
  int first_error_ = 0;
};

}  // namespace coordreq::hdf5
