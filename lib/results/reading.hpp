#pragma once

#include <string>

#include "base/error.hpp"
#include "results/hdf5_handle.hpp"

namespace coordreq {

/// `read()` with the HDF5 library's errors as ours.
/// @throws IoError if the system could not read; ResultsError for what else the library does not like
template <class Read>
auto reading(const std::string& path, const Read& read) {
  const hdf5::QuietErrors quiet;
  try {
    return read();
  } catch (const hdf5::Failure& failure) {
    if (failure.system_error() != 0) throw IoError(failure.what(), path);
    throw ResultsError(std::string("damaged results file: ") + failure.what(), path);
  }
}

}  // namespace coordreq
