#include "results/netcdf_writer.hpp"

#include <fmt/format.h>

#include <cstring>

#include "results/hdf5_handle.hpp"

namespace coordreq {
namespace {

/// An entry of a scale's REFERENCE_LIST as it lies in the file.
struct ReferenceRecord {
  hobj_ref_t dataset;
  std::int32_t dimension;
  std::int32_t padding;
};

hdf5::Handle reference_record_type() {
  hdf5::Handle type(H5Tcreate(H5T_COMPOUND, sizeof(ReferenceRecord)), H5Tclose, "create a type");
  hdf5::check(H5Tinsert(type.get(), "dataset", offsetof(ReferenceRecord, dataset), H5T_STD_REF_OBJ),
              "create a type");
  hdf5::check(H5Tinsert(type.get(), "dimension", offsetof(ReferenceRecord, dimension), H5T_STD_I32LE),
              "create a type");
  return type;
}

std::string last_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

}  // namespace

NetcdfWriter::NetcdfWriter(const std::string& path, ThreadTeam& team, RankChunks* ranks)
    : file_(hdf5::create_file(path, driver_)), arrays_(team, driver_, ranks) {}

void NetcdfWriter::make_groups(const std::string& path) {
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    const htri_t found = H5Lexists(file_.get(), group.c_str(), H5P_DEFAULT);
    hdf5::check(found, "look for the group " + group);
    if (found == 0) hdf5::create_group(file_, group).close("close the group " + group);
  }
}

void NetcdfWriter::make_scale(const hdf5::Handle& dataset, const std::string& path, std::uint64_t length,
                              const std::string& name) {
  hdf5::set_ascii_attribute(dataset, "CLASS", "DIMENSION_SCALE");
  hdf5::set_ascii_attribute(dataset, "NAME", name);
  hdf5::set_attribute(dataset, "_Netcdf4Dimid", static_cast<std::int32_t>(dimensions_.size()));
  dimensions_[path].length = length;
}

void NetcdfWriter::add_dimension(const std::string& path, std::uint64_t length) {
  make_groups(path);
  const hdf5::Handle dataset =
      hdf5::create_dataset(file_, path, H5T_IEEE_F32BE, hdf5::create_space({length}));
  // netCDF-4 knows a dimension without a variable by this text and the width of the number.
  make_scale(dataset, path, length,
             fmt::format("This is a netCDF dimension but not a netCDF variable.{:10d}", length));
}

hdf5::Handle NetcdfWriter::add_coordinates(const std::string& path, std::uint64_t length,
                                           const ResultArray& array) {
  make_groups(path);
  hdf5::Handle dataset = arrays_.write(file_, path, {length}, array);
  make_scale(dataset, path, length, last_name(path));
  return dataset;
}

hdf5::Handle NetcdfWriter::add_coordinates(const std::string& path, const std::vector<std::string>& texts) {
  make_groups(path);
  std::vector<const char*> data;
  data.reserve(texts.size());
  for (const std::string& text : texts) data.push_back(text.c_str());
  const hdf5::Handle type = hdf5::string_type();
  hdf5::Handle dataset = hdf5::create_dataset(file_, path, type.get(), hdf5::create_space({texts.size()}));
  hdf5::check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, hdf5::text_transfer().get(), data.data()),
              "write the dataset " + path);
  make_scale(dataset, path, texts.size(), last_name(path));
  return dataset;
}

hdf5::Handle NetcdfWriter::add_array(const std::string& path, const std::vector<std::string>& dimensions,
                                     const ResultArray& array) {
  make_groups(path);
  hdf5::Handle dataset = arrays_.write(file_, path, shape_of(dimensions), array);
  attach(dataset, path, dimensions);
  return dataset;
}

hdf5::Handle NetcdfWriter::add_copy(const std::string& path, const std::vector<std::string>& dimensions,
                                    const ResultArray& array, const hdf5::Handle& original) {
  make_groups(path);
  hdf5::Handle dataset = arrays_.write_copy(file_, path, shape_of(dimensions), array, original);
  attach(dataset, path, dimensions);
  return dataset;
}

std::vector<hsize_t> NetcdfWriter::shape_of(const std::vector<std::string>& dimensions) const {
  std::vector<hsize_t> shape;
  shape.reserve(dimensions.size());
  for (const std::string& dimension : dimensions) shape.push_back(dimensions_.at(dimension).length);
  return shape;
}

hdf5::Handle NetcdfWriter::add_text(const std::string& path, const std::string& text) {
  make_groups(path);
  const char* data = text.c_str();
  const hdf5::Handle type = hdf5::string_type();
  hdf5::Handle dataset = hdf5::create_dataset(file_, path, type.get(), hdf5::create_space({}));
  hdf5::check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, hdf5::text_transfer().get(), &data),
              "write the dataset " + path);
  return dataset;
}

void NetcdfWriter::attach(const hdf5::Handle& dataset, const std::string& path,
                          const std::vector<std::string>& dimensions) {
  if (dimensions.empty()) return;
  std::vector<hobj_ref_t> references;
  for (std::size_t axis = 0; axis < dimensions.size(); ++axis) {
    references.push_back(reference_to(dimensions[axis]));
    dimensions_.at(dimensions[axis]).uses.push_back({path, static_cast<std::int32_t>(axis)});
  }
  std::vector<hvl_t> lists;
  lists.reserve(references.size());
  for (hobj_ref_t& reference : references) lists.push_back({1, &reference});

  const hdf5::Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose, "create a type");
  const hdf5::Handle attribute =
      hdf5::create_attribute(dataset, "DIMENSION_LIST", type.get(), hdf5::create_space({lists.size()}));
  hdf5::check(H5Awrite(attribute.get(), type.get(), lists.data()), "name the axes of " + path);
}

hobj_ref_t NetcdfWriter::reference_to(const std::string& path) const {
  hobj_ref_t reference = 0;
  hdf5::check(H5Rcreate(&reference, file_.get(), path.c_str(), H5R_OBJECT, -1), "refer to " + path);
  return reference;
}

void NetcdfWriter::write_uses(const std::string& path, const Dimension& dimension) const {
  if (dimension.uses.empty()) return;
  std::vector<ReferenceRecord> records;
  for (const Use& use : dimension.uses) records.push_back({reference_to(use.dataset), use.axis, 0});
  const hdf5::Handle type = reference_record_type();
  const hdf5::Handle dataset = hdf5::open_object(file_, path);
  const hdf5::Handle attribute =
      hdf5::create_attribute(dataset, "REFERENCE_LIST", type.get(), hdf5::create_space({records.size()}));
  hdf5::check(H5Awrite(attribute.get(), type.get(), records.data()), "list the uses of " + path);
}

void NetcdfWriter::finish() {
  for (const auto& [path, dimension] : dimensions_) write_uses(path, dimension);
  // HDF5 1.10 crashes where a list of its free blocks cannot be allocated while a file is closed.
  hdf5::expect_memory();
  file_.close("close the file");
  driver_.check_written("write the file");
}

}  // namespace coordreq
