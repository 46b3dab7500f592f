#include "results/hdf5_handle.hpp"

#include <sys/resource.h>

#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "base/process_memory.hpp"
#include "base/requires.hpp"
#include "results/output_driver.hpp"

namespace coordreq::hdf5 {
namespace {

static_assert(std::endian::native == std::endian::little,
              "chunks are packed as they lie in memory, and the file is little-endian");

constexpr unsigned kOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

/// Without a limit the system gives what is requested, unless a damaged file requests too much.
bool may_lack_memory() {
  rlimit limit{};
  return is_held_to_memory() || (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY);
}

/// The library does not always say why it failed.
bool is_little_memory_left() {
  constexpr std::size_t kLittle = std::size_t{2} << 20;
  const std::unique_ptr<std::byte[]> probe(new (std::nothrow) std::byte[kLittle]);
  return probe == nullptr;
}

herr_t look_for_memory(unsigned /*depth*/, const H5E_error2_t* error, void* result) {
  if (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC) *static_cast<bool*>(result) = true;
  return 0;
}

/// The innermost error is the one that the system call met; its text holds "errno = N".
herr_t read_system_error(unsigned /*depth*/, const H5E_error2_t* error, void* result) {
  constexpr std::string_view kMark = "errno = ";
  if (error->desc == nullptr) return 0;
  const char* found = std::strstr(error->desc, kMark.data());
  if (found != nullptr) *static_cast<int*>(result) = std::atoi(found + kMark.size());
  return 0;
}

[[noreturn]] void fail(std::string_view what) {
  int system_error = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, read_system_error, &system_error);
  bool lacks_memory = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, look_for_memory, &lacks_memory);
  lacks_memory = may_lack_memory() && (lacks_memory || is_little_memory_left());
  if (system_error == ENOMEM || (system_error == 0 && lacks_memory)) throw std::bad_alloc();
  std::string text = "cannot " + std::string(what);
  if (system_error != 0) text += std::string(": ") + std::strerror(system_error);
  throw Failure(text, system_error);
}

Handle property_list(hid_t kind) {
  return {H5Pcreate(kind), H5Pclose, "create a property list"};
}

/// By itself the library keeps descriptions of objects of up to 32 MiB, which take more than that in memory.
void limit_kept_objects(const Handle& list) {
  H5AC_cache_config_t config{};
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(list.get(), &config), "read the limits of its cache");
  config.set_initial_size = 1;
  config.initial_size = config.min_size = config.max_size = std::size_t{1} << 20U;
  check(H5Pset_mdc_config(list.get(), &config), "limit its cache");
}

/// No locks: the file written has a name that no other process uses, a results file never changes once it is
/// there, and on some cluster file systems locks do not work.
Handle access_properties() {
  Handle list = property_list(H5P_FILE_ACCESS);
  check(H5Pset_libver_bounds(list.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "set the format version");
  check(H5Pset_file_locking(list.get(), 0, 1), "turn file locking off");
  limit_kept_objects(list);
  return list;
}

void track_order_not_times(const Handle& list) {
  check(H5Pset_obj_track_times(list.get(), 0), "turn object times off");
  check(H5Pset_attr_creation_order(list.get(), kOrder), "track the order of attributes");
}

void write_attribute(const Handle& object, const std::string& name, hid_t type, const Handle& space,
                     const void* data) {
  Handle attribute = create_attribute(object, name, type, space);
  check(H5Awrite(attribute.get(), type, data), "write the attribute " + name);
}

}  // namespace

QuietErrors::QuietErrors() {
  // At exit the library prints errors when memory is short; everything that we open is closed by then.
  static_cast<void>(H5dont_atexit());
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

Handle::Handle(hid_t id, Close close_function, std::string_view what) : id_(id), close_(close_function) {
  if (id < 0) fail(what);
}

Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

Handle::Handle(Handle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

void Handle::close(std::string_view what) {
  check(close_(std::exchange(id_, H5I_INVALID_HID)), what);
}

void check(herr_t status, std::string_view what) {
  if (status < 0) fail(what);
}

void expect_memory() {
  if (may_lack_memory() && is_little_memory_left()) throw std::bad_alloc();
}

Handle create_file(const std::string& path, OutputDriver& driver) {
  const Handle list = property_list(H5P_FILE_CREATE);
  track_order_not_times(list);
  check(H5Pset_link_creation_order(list.get(), kOrder), "track the order of links");
  const Handle access = access_properties();
  driver.use_for(access);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, list.get(), access.get()), H5Fclose, "create the file"};
}

Handle open_file(const std::string& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access_properties().get()), H5Fclose, "open the file"};
}

Handle create_group(const Handle& file, const std::string& path) {
  const Handle list = property_list(H5P_GROUP_CREATE);
  track_order_not_times(list);
  check(H5Pset_link_creation_order(list.get(), kOrder), "track the order of links");
  return {H5Gcreate2(file.get(), path.c_str(), H5P_DEFAULT, list.get(), H5P_DEFAULT), H5Gclose,
          "create the group " + path};
}

Handle open_object(const Handle& file, const std::string& path) {
  return {H5Oopen(file.get(), path.c_str(), H5P_DEFAULT), H5Oclose, "open " + path};
}

Handle create_dataset(const Handle& file, const std::string& path, hid_t type, const Handle& space,
                      const Storage& storage) {
  const std::string what = "create the dataset " + path;
  const Handle list = property_list(H5P_DATASET_CREATE);
  track_order_not_times(list);
  if (!storage.chunk.empty()) {
    check(H5Pset_chunk(list.get(), static_cast<int>(storage.chunk.size()), storage.chunk.data()), what);
    if (storage.shuffle) check(H5Pset_shuffle(list.get()), what);
    check(H5Pset_deflate(list.get(), static_cast<unsigned>(storage.deflate_level)), what);
  }
  return {H5Dcreate2(file.get(), path.c_str(), type, space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
          H5Dclose, what};
}

Handle create_space(const std::vector<hsize_t>& shape) {
  const hid_t id = shape.empty() ? H5Screate(H5S_SCALAR)
                                 : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  return {id, H5Sclose, "create a data space"};
}

Handle create_attribute(const Handle& object, const std::string& name, hid_t type, const Handle& space) {
  return {H5Acreate2(object.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
          "create the attribute " + name};
}

Handle string_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "create a type");
  check(H5Tset_size(type.get(), H5T_VARIABLE), "create a type");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "create a type");
  return type;
}

Handle text_transfer() {
  constexpr std::size_t kBufferBytes = 4096;
  Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "create a property list");
  check(H5Pset_buffer(transfer.get(), kBufferBytes, nullptr, nullptr), "set the size of a buffer");
  return transfer;
}

Handle fixed_string_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "create a type");
  check(H5Tset_size(type.get(), size), "create a type");
  return type;
}

hid_t number_type(ElementType type) {
  switch (type) {
    case ElementType::uint8:
      return H5T_STD_U8LE;
    case ElementType::int16:
      return H5T_STD_I16LE;
    case ElementType::int32:
      return H5T_STD_I32LE;
    case ElementType::uint32:
      return H5T_STD_U32LE;
    case ElementType::int64:
      return H5T_STD_I64LE;
    case ElementType::uint64:
      return H5T_STD_U64LE;
    case ElementType::float32:
      return H5T_IEEE_F32LE;
    case ElementType::float64:
      break;
  }
  return H5T_IEEE_F64LE;
}

bool holds_long_strings(const Handle& type) {
  return H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) > 0;
}

LibraryStrings::~LibraryStrings() {
  H5Dvlen_reclaim(type_.get(), space_.get(), H5P_DEFAULT, texts_.data());
}

std::vector<std::string> LibraryStrings::copy() const {
  std::vector<std::string> result;
  for (const char* text : texts_) result.emplace_back(text == nullptr ? "" : text);
  return result;
}

std::vector<hsize_t> shape_of(const Handle& space) {
  const int rank = H5Sget_simple_extent_ndims(space.get());
  check(rank, "read a shape");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), "read a shape");
  return shape;
}

void set_attribute(const Handle& object, const std::string& name, const std::string& text) {
  const char* data = text.c_str();
  write_attribute(object, name, string_type().get(), create_space({}), &data);
}

void set_attribute(const Handle& object, const std::string& name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, std::int32_t value) {
  write_attribute(object, name, H5T_STD_I32LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, H5T_STD_I64LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, std::uint64_t value) {
  write_attribute(object, name, H5T_STD_U64LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, ElementType type,
                   const std::vector<std::int64_t>& values) {
  REQUIRES(type != ElementType::float32 && type != ElementType::float64);
  std::vector<std::int64_t> converted = values;
  check(
      H5Tconvert(H5T_STD_I64LE, number_type(type), converted.size(), converted.data(), nullptr, H5P_DEFAULT),
      "convert the attribute " + name);
  write_attribute(object, name, number_type(type), create_space({values.size()}), converted.data());
}

void set_ascii_attribute(const Handle& object, const std::string& name, const std::string& text) {
  const Handle type = fixed_string_type(text.size() + 1);
  write_attribute(object, name, type.get(), create_space({}), text.c_str());
}

}  // namespace coordreq::hdf5
