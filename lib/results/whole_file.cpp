#include "results/output_file.hpp"

#include <cstring>

#include "base/error.hpp"
#include "results/hdf5_handle.hpp"

namespace coordreq {

void write_whole_file(const std::string& path, const std::string& what,
                      const std::function<void(const std::string& temporary)>& write) {
  OutputFile output(path);
  const hdf5::QuietErrors quiet;
  try {
    write(output.temporary());
  } catch (const hdf5::Failure& failure) {
    const std::string reason =
        failure.system_error() == 0 ? failure.what() : std::strerror(failure.system_error());
    throw IoError("cannot write " + what + ": " + reason, path);
  }
  output.commit();
}

}  // namespace coordreq
