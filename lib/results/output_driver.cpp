#include "results/output_driver.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace coordreq::hdf5 {
namespace {

/// The data that the access property list carries to open_output().
struct DriverInfo {
  int* first_error;
};

/// The library sees the first member only.
struct OutputState {
  H5FD_t base;
  int descriptor;
  haddr_t end_of_allocation;
  haddr_t end_of_file;
  int* first_error;
};

OutputState& state_of(H5FD_t* file) {
  return *reinterpret_cast<OutputState*>(file);
}

const OutputState& state_of(const H5FD_t* file) {
  return *reinterpret_cast<const OutputState*>(file);
}

void note_error(const OutputState& state) {
  if (*state.first_error == 0) *state.first_error = errno;
}

H5FD_t* open_output(const char* name, unsigned flags, hid_t access, haddr_t /*maxaddr*/) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  const int truncate = (flags & H5F_ACC_TRUNC) != 0 ? O_TRUNC : 0;
  const int descriptor = open(name, O_RDWR | O_CLOEXEC | truncate);
  if (info == nullptr || descriptor < 0) return nullptr;
  const off_t end = lseek(descriptor, 0, SEEK_END);
  auto* state = new (std::nothrow) OutputState{};
  if (state == nullptr) {
    close(descriptor);
    return nullptr;
  }
  state->descriptor = descriptor;
  state->end_of_file = static_cast<haddr_t>(std::max<off_t>(0, end));
  state->first_error = info->first_error;
  return &state->base;
}

herr_t close_output(H5FD_t* file) {
  const std::unique_ptr<OutputState> state(&state_of(file));
  if (close(state->descriptor) != 0) note_error(*state);
  return 0;
}

herr_t query_output(const H5FD_t* /*file*/, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_allocation(const H5FD_t* file, H5FD_mem_t /*type*/) {
  return state_of(file).end_of_allocation;
}

herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t end) {
  state_of(file).end_of_allocation = end;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t /*type*/) {
  return state_of(file).end_of_file;
}

/// Bytes that were never written read as zeros.
herr_t read_output(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t offset, std::size_t size,
                   void* buffer) {
  auto* out = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t count = pread(state_of(file).descriptor, out, size, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) note_error(state_of(file));
    if (count <= 0) break;
    out += count;
    offset += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  std::memset(out, 0, size);
  return 0;
}

herr_t write_output(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t offset, std::size_t size,
                    const void* buffer) {
  OutputState& state = state_of(file);
  const auto* data = static_cast<const char*>(buffer);
  state.end_of_file = std::max<haddr_t>(state.end_of_file, offset + size);
  while (size > 0) {
    const ssize_t count = pwrite(state.descriptor, data, size, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      note_error(state);
      return 0;
    }
    data += count;
    offset += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  return 0;
}

herr_t truncate_output(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  OutputState& state = state_of(file);
  if (state.end_of_allocation == state.end_of_file) return 0;
  if (ftruncate(state.descriptor, static_cast<off_t>(state.end_of_allocation)) != 0) note_error(state);
  state.end_of_file = state.end_of_allocation;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 0)
  driver.version = H5FD_CLASS_VERSION;
  driver.value = 600;  // any number from 512 to 65535 that is not registered with the HDF Group
#endif
  driver.name = "coordreq-output";
  driver.maxaddr = (haddr_t{1} << 62U) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_output;
  driver.close = close_output;
  driver.query = query_output;
  driver.get_eoa = end_of_allocation;
  driver.set_eoa = set_end_of_allocation;
  driver.get_eof = end_of_file;
  driver.read = read_output;
  driver.write = write_output;
  driver.truncate = truncate_output;
  const H5FD_mem_t lists[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(lists), std::end(lists), std::begin(driver.fl_map));
  return driver;
}

Handle register_driver() {
  const H5FD_class_t driver = driver_class();
  return {H5FDregister(&driver), H5FDunregister, "register the file driver"};
}

}  // namespace

OutputDriver::OutputDriver() : id_(register_driver()) {}

void OutputDriver::use_for(const Handle& access) {
  const DriverInfo info{&first_error_};
  check(H5Pset_driver(access.get(), id_.get(), &info), "choose the file driver");
}

void OutputDriver::check_written(const std::string& what) const {
  if (first_error_ != 0) throw Failure("cannot " + what, first_error_);
}

}  // namespace coordreq::hdf5
