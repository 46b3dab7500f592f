#include "results/write_vtkhdf.hpp"

#include "results/array_writer.hpp"
#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/output_driver.hpp"
#include "results/whole_file.hpp"

namespace coordreq {
namespace {

using hdf5::set_attribute;

void set_numbers(const hdf5::Handle& object, const std::string& name, const std::vector<double>& values) {
  const hdf5::Handle attribute =
      hdf5::create_attribute(object, name, H5T_IEEE_F64LE, hdf5::create_space({values.size()}));
  hdf5::check(H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, values.data()), "write the attribute " + name);
}

void describe(const hdf5::Handle& group, const ImageContent& content) {
  set_attribute(group, "Version", ElementType::int32, {1, 0});
  hdf5::set_ascii_attribute(group, "Type", "ImageData");
  std::vector<std::int64_t> extent;  // of the points, which are one more than the cells
  for (const std::uint64_t cells : content.cells) {
    extent.push_back(0);
    extent.push_back(static_cast<std::int64_t>(cells));
  }
  set_attribute(group, "WholeExtent", ElementType::int32, extent);
  set_numbers(group, "Origin", {content.origin.begin(), content.origin.end()});
  set_numbers(group, "Spacing", {content.spacing.begin(), content.spacing.end()});
  set_numbers(group, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  set_attribute(group, "title", content.title);
  set_attribute(group, "x_axis", content.axes[0]);
  set_attribute(group, "y_axis", content.axes[1]);
  set_attribute(group, "z_axis", content.axes[2]);
  set_attribute(group, "cut", content.cut);
}

void write_content(const std::string& path, const ImageContent& content, ThreadTeam& team) {
  hdf5::OutputDriver driver;
  hdf5::Handle file = hdf5::create_file(path, driver);
  describe(hdf5::create_group(file, "/VTKHDF"), content);
  hdf5::create_group(file, "/VTKHDF/CellData").close("close a group");
  ArrayWriter writer(team, driver);
  const std::vector<hsize_t> shape = {content.cells[2], content.cells[1], content.cells[0]};
  for (const ImageContent::Array& array : content.arrays) {
    writer.write(file, "/VTKHDF/CellData/" + array.name, shape, array.values).close("close a dataset");
  }
  file.close("close the file");
  driver.check_written("write the file");
}

}  // namespace

void write_vtkhdf(const std::string& path, const ImageContent& content, ThreadTeam& team) {
  write_whole_file(path, "the image",
                   [&](const std::string& temporary) { write_content(temporary, content, team); });
}

}  // namespace coordreq
