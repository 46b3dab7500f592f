#include "results/stored_object.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "results/child_trial.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"

namespace coordreq {
namespace {

/// No attribute of ours has more: it is a number for each mode of a network at the most.
constexpr hssize_t kMostElements = 4096;

/// How netCDF-4 calls an axis without coordinates.
constexpr const char* kLengthOnly = "This is a netCDF dimension";

std::string name_of(const hdf5::Handle& attribute) {
  std::array<char, 256> name{};
  hdf5::check(static_cast<herr_t>(H5Aget_name(attribute.get(), name.size(), name.data())),
              "read the name of an attribute");
  return name.data();
}

template <class Number>
std::vector<Number> elements(const hdf5::Handle& attribute, hid_t type) {
  const hdf5::Handle space(H5Aget_space(attribute.get()), H5Sclose, "read a shape");
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0 || count > kMostElements) return {};
  std::vector<Number> values(static_cast<std::size_t>(count));
  hdf5::check(H5Aread(attribute.get(), type, values.data()), "read the attribute " + name_of(attribute));
  return values;
}

void read_attribute(const ResultsFile& file, const hdf5::Handle& attribute, StoredObject& object) {
  const std::string name = name_of(attribute);
  const hdf5::Handle type(H5Aget_type(attribute.get()), H5Tclose, "read a type");
  switch (H5Tget_class(type.get())) {
    case H5T_INTEGER:
      object.integers[name] = elements<std::int64_t>(attribute, H5T_NATIVE_INT64);
      break;
    case H5T_FLOAT:
      object.numbers[name] = elements<double>(attribute, H5T_NATIVE_DOUBLE);
      break;
    case H5T_STRING:
      if (H5Tis_variable_str(type.get()) > 0) object.texts[name] = file.text(object.path, name);
      break;
    default:
      break;  // references, which are read as axes
  }
}

void read_scale(const hdf5::Handle& dataset, StoredObject& object) {
  object.is_scale = H5DSis_scale(dataset.get()) > 0;
  if (!object.is_scale) return;
  std::array<char, 1024> name{};
  if (H5DSget_scale_name(dataset.get(), name.data(), name.size()) > 0) object.scale_name = name.data();
}

bool has_only_zeros(const ResultsFile& file, const hdf5::Handle& dataset, const std::string& path) {
  if (H5Dget_storage_size(dataset.get()) == 0) return true;  // as it is written
  const std::vector<double> values = file.numbers(path);
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
}

StoredObject read_object(const ResultsFile& file, const hdf5::Handle& handle, const std::string& path) {
  StoredObject object{.path = path};
  H5O_info_t info{};
  hdf5::check(H5Oget_info(handle.get(), &info), "look at " + path);
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const hdf5::Handle attribute(
        H5Aopen_by_idx(handle.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        "open an attribute of " + path);
    read_attribute(file, attribute, object);
  }
  if (info.type != H5O_TYPE_DATASET) return object;
  read_scale(handle, object);
  if (object.scale_name.rfind(kLengthOnly, 0) == 0) object.is_blank = has_only_zeros(file, handle, path);
  if (!object.is_scale && !file.shape(path).empty()) object.axes = file.axis_paths(path);
  return object;
}

std::vector<StoredObject> read_all(const std::string& path, const std::vector<std::string>& paths) {
  const ResultsFile file(path);
  std::vector<StoredObject> objects;
  for (const std::string& object : paths) {
    objects.push_back(read_object(file, file.open(object), object));
  }
  return objects;
}

}  // namespace

std::vector<StoredObject> read_objects(const std::string& file, const std::vector<std::string>& paths) {
  const auto read = [&] { return reading(file, [&] { return read_all(file, paths); }); };
  try_in_child(file, [&read] { static_cast<void>(read()); });
  return read();
}

}  // namespace coordreq
