#include "results/results_file.hpp"

#include <fcntl.h>
#include <hdf5_hl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "results/version.hpp"

namespace coordreq {
namespace {

/// Groups in a results file are nested three deep; a file whose groups hold one another must not hang us.
constexpr int kDeepestGroup = 8;

/// The system's reason why a file cannot be read is clearer than HDF5's. @returns the length
std::uint64_t check_readable(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw IoError(std::string("cannot read the results: ") + std::strerror(errno), path);
  struct stat info {};
  const bool known = fstat(file, &info) == 0;
  close(file);
  if (known && S_ISDIR(info.st_mode)) throw IoError("cannot read the results: this is a folder", path);
  if (!known || !S_ISREG(info.st_mode)) {
    throw IoError("cannot read the results: this is a device, a pipe or a socket, not a regular file", path);
  }
  return static_cast<std::uint64_t>(info.st_size);
}

hdf5::Handle open_results(const std::string& path) {
  try {
    return hdf5::open_file(path);
  } catch (const hdf5::Failure& failure) {
    if (failure.system_error() != 0) throw IoError(failure.what(), path);
    throw ResultsError("not a coordreq results file: it is not HDF5, or cut short", path);
  }
}

hdf5::Handle space_of_attribute(const hdf5::Handle& attribute) {
  return {H5Aget_space(attribute.get()), H5Sclose, "read a shape"};
}

std::uint64_t element_count(const hdf5::Handle& space) {
  return static_cast<std::uint64_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.get())));
}

/// Lists of references to objects, which the library has made.
class LibraryLists {
 public:
  LibraryLists(const hdf5::Handle& attribute, const hdf5::Handle& type, const hdf5::Handle& space,
               std::size_t count)
      : type_(type), space_(space), lists_(count) {
    hdf5::check(H5Aread(attribute.get(), type.get(), lists_.data()), "read a list of references");
  }
  ~LibraryLists() { H5Dvlen_reclaim(type_.get(), space_.get(), H5P_DEFAULT, lists_.data()); }
  LibraryLists(const LibraryLists&) = delete;
  LibraryLists& operator=(const LibraryLists&) = delete;

  /// Empty if the list is, or the object is no longer there.
  [[nodiscard]] std::string first_referred_path(const hdf5::Handle& file, std::size_t list) const {
    std::array<char, 1024> path{};
    if (lists_[list].len == 0) return {};
    const ssize_t length = H5Rget_name(file.get(), H5R_OBJECT, lists_[list].p, path.data(), path.size());
    return length > 0 ? path.data() : std::string();
  }

 private:
  const hdf5::Handle& type_;
  const hdf5::Handle& space_;
  std::vector<hvl_t> lists_;
};

}  // namespace

ResultsFile::ResultsFile(const std::string& path, std::size_t cache_bytes)
    : path_(path), bytes_(check_readable(path)), file_(open_results(path)), cache_(cache_bytes) {
  check_format();
}

void ResultsFile::check_format() const {
  if (!has("/", "filetype") || text("/", "filetype") != kResultsFiletype) {
    throw ResultsError("not a coordreq results file: the attribute filetype is not \"" +
                           std::string(kResultsFiletype) + "\"",
                       path_);
  }
  const hdf5::Handle attribute = open_attribute("/", "version");
  std::array<std::int32_t, 2> version{};
  if (element_count(space_of_attribute(attribute)) != version.size()) {
    throw ResultsError("the attribute version does not hold two numbers", location("/"));
  }
  hdf5::check(H5Aread(attribute.get(), H5T_NATIVE_INT32, version.data()), "read the attribute version");
  if (version[0] != kResultsVersion[0]) {
    throw ResultsError("version " + std::to_string(version[0]) + "." + std::to_string(version[1]) +
                           " of the results format, expected version " + std::to_string(kResultsVersion[0]),
                       path_);
  }
}

std::string ResultsFile::location(const std::string& object) const {
  return path_ + ":" + object;
}

bool ResultsFile::exists(const std::string& path) const {
  // The library wants every group along the path to be there, and follows whatever link there is.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string prefix = path.substr(0, end);
    if (prefix == "/") return true;
    if (H5Lexists(file_.get(), prefix.c_str(), H5P_DEFAULT) <= 0) return false;
    H5L_info_t info{};
    hdf5::check(H5Lget_info(file_.get(), prefix.c_str(), &info, H5P_DEFAULT), "look at " + prefix);
    if (info.type != H5L_TYPE_HARD)
      throw ResultsError("a link to an object elsewhere, which results do not have", location(prefix));
    if (end == std::string::npos) return true;
  }
}

hdf5::Handle ResultsFile::open(const std::string& path) const {
  if (!exists(path)) throw ResultsError("missing or damaged", location(path));
  try {
    return hdf5::open_object(file_, path);
  } catch (const hdf5::Failure&) {
    throw ResultsError("missing or damaged", location(path));
  }
}

hdf5::Handle ResultsFile::open_attribute(const std::string& path, const std::string& attribute) const {
  if (!has(path, attribute)) throw ResultsError("the attribute " + attribute + " is missing", location(path));
  return {H5Aopen(open(path).get(), attribute.c_str(), H5P_DEFAULT), H5Aclose,
          "open the attribute " + attribute};
}

bool ResultsFile::has(const std::string& path, const std::string& attribute) const {
  return H5Aexists(open(path).get(), attribute.c_str()) > 0;
}

void ResultsFile::read_attribute(const std::string& path, const std::string& attribute, hid_t type,
                                 std::initializer_list<H5T_class_t> classes, std::uint64_t count,
                                 void* out) const {
  const hdf5::Handle handle = open_attribute(path, attribute);
  const hdf5::Handle stored(H5Aget_type(handle.get()), H5Tclose, "read a type");
  const H5T_class_t found = H5Tget_class(stored.get());
  if (element_count(space_of_attribute(handle)) != count ||
      std::find(classes.begin(), classes.end(), found) == classes.end()) {
    const std::string expected = count == 1 ? "one number" : std::to_string(count) + " integers";
    throw ResultsError("the attribute " + attribute + " is not " + expected, location(path));
  }
  hdf5::check(H5Aread(handle.get(), type, out), "read the attribute " + attribute);
}

double ResultsFile::number(const std::string& path, const std::string& attribute) const {
  double value = 0;
  read_attribute(path, attribute, H5T_NATIVE_DOUBLE, {H5T_FLOAT, H5T_INTEGER}, 1, &value);
  if (!std::isfinite(value))
    throw ResultsError("the attribute " + attribute + " is not a finite number", location(path));
  return value;
}

std::int64_t ResultsFile::integer(const std::string& path, const std::string& attribute) const {
  std::int64_t value = 0;
  read_attribute(path, attribute, H5T_NATIVE_INT64, {H5T_INTEGER}, 1, &value);
  return value;
}

std::uint64_t ResultsFile::natural(const std::string& path, const std::string& attribute) const {
  return naturals(path, attribute, 1).front();
}

std::vector<std::uint64_t> ResultsFile::naturals(const std::string& path, const std::string& attribute,
                                                 std::uint64_t count) const {
  REQUIRES(count >= 1);
  std::vector<std::int64_t> values(count);
  read_attribute(path, attribute, H5T_NATIVE_INT64, {H5T_INTEGER}, count, values.data());
  if (std::any_of(values.begin(), values.end(), [](std::int64_t value) { return value < 0; }))
    throw ResultsError("the attribute " + attribute + " is negative", location(path));
  return {values.begin(), values.end()};
}

std::string ResultsFile::text(const std::string& path, const std::string& attribute) const {
  const hdf5::Handle handle = open_attribute(path, attribute);
  const hdf5::Handle space = space_of_attribute(handle);
  const hdf5::Handle type(H5Aget_type(handle.get()), H5Tclose, "read a type");
  if (!hdf5::holds_long_strings(type) || element_count(space) != 1) {
    throw ResultsError("the attribute " + attribute + " is not a variable-length string", location(path));
  }
  hdf5::LibraryStrings strings(type, space, 1);
  hdf5::check(H5Aread(handle.get(), type.get(), strings.data()), "read the attribute " + attribute);
  return strings.copy().front();
}

std::vector<std::string> ResultsFile::axis_paths(const std::string& dataset) const {
  const std::size_t rank = shape(dataset).size();
  const hdf5::Handle attribute = open_attribute(dataset, "DIMENSION_LIST");
  const hdf5::Handle space = space_of_attribute(attribute);
  const hdf5::Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose, "create a type");
  if (element_count(space) != rank)
    throw ResultsError("not every axis has a dimension scale", location(dataset));
  const LibraryLists lists(attribute, type, space, rank);
  std::vector<std::string> names;
  for (std::size_t axis = 0; axis < rank; ++axis) {
    const std::string path = lists.first_referred_path(file_, axis);
    if (path.empty()) {
      throw ResultsError("axis " + std::to_string(axis) + " has no dimension scale", location(dataset));
    }
    names.push_back(path);
  }
  return names;
}

std::vector<std::string> ResultsFile::axes(const std::string& dataset) const {
  std::vector<std::string> names = axis_paths(dataset);
  for (std::string& name : names) name.erase(0, name.rfind('/') + 1);
  return names;
}

std::vector<std::string> ResultsFile::members(const std::string& group) const {
  const hdf5::Handle handle = open(group);
  H5G_info_t info{};
  hdf5::check(H5Gget_info(handle.get(), &info), "list " + group);
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name_of = [&](H5_index_t index, char* out, std::size_t size) {
      return H5Lget_name_by_idx(handle.get(), ".", index, H5_ITER_INC, i, out, size, H5P_DEFAULT);
    };
    // A tool that rewrote the file may have lost the order of creation.
    H5_index_t index = H5_INDEX_CRT_ORDER;
    ssize_t length = name_of(index, nullptr, 0);
    if (length < 0) length = name_of(index = H5_INDEX_NAME, nullptr, 0);
    hdf5::check(static_cast<herr_t>(length), "list " + group);
    std::string name(static_cast<std::size_t>(length), '\0');
    name_of(index, name.data(), name.size() + 1);
    names.push_back(name);
  }
  return names;
}

void ResultsFile::collect_datasets(const std::string& group, int depth,
                                   std::vector<std::string>& found) const {
  if (depth > kDeepestGroup) throw ResultsError("groups nested too deep", location(group));
  for (const std::string& name : members(group.empty() ? "/" : group)) {
    const std::string path = group + "/" + name;
    const hdf5::Handle object = open(path);
    const H5I_type_t kind = H5Iget_type(object.get());
    if (kind == H5I_GROUP) collect_datasets(path, depth + 1, found);
    if (kind != H5I_DATASET) continue;
    std::array<char, 64> scale_name{};
    const bool is_scale = H5DSis_scale(object.get()) > 0;
    if (is_scale) H5DSget_scale_name(object.get(), scale_name.data(), scale_name.size());
    if (std::strncmp(scale_name.data(), "This is a netCDF dimension", 26) != 0) found.push_back(path);
  }
}

std::vector<std::string> ResultsFile::datasets() const {
  std::vector<std::string> found;
  collect_datasets("", 0, found);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace coordreq
