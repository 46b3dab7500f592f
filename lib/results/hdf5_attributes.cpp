#include "results/hdf5_attributes.hpp"

#include <cstddef>

namespace coordreq::hdf5 {
namespace {

void write(const Handle& object, const std::string& name, hid_t type, const Handle& space, const void* data) {
  Handle attribute = create_attribute(object, name, type, space);
  check(H5Awrite(attribute.get(), type, data), "write the attribute " + name);
}

}  // namespace

void set_attribute(const Handle& object, const std::string& name, const std::string& text) {
  const char* data = text.c_str();
  write(object, name, string_type().get(), create_space({}), &data);
}

void set_attribute(const Handle& object, const std::string& name, double value) {
  write(object, name, H5T_IEEE_F64LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, std::int32_t value) {
  write(object, name, H5T_STD_I32LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, std::int64_t value) {
  write(object, name, H5T_STD_I64LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, std::uint64_t value) {
  write(object, name, H5T_STD_U64LE, create_space({}), &value);
}

void set_attribute(const Handle& object, const std::string& name, ElementType type,
                   const std::vector<std::int64_t>& values) {
  std::vector<std::int64_t> converted = values;
  check(
      H5Tconvert(H5T_STD_I64LE, number_type(type), converted.size(), converted.data(), nullptr, H5P_DEFAULT),
      "convert the attribute " + name);
  write(object, name, number_type(type), create_space({values.size()}), converted.data());
}

void set_ascii_attribute(const Handle& object, const std::string& name, const std::string& text) {
  const Handle type = fixed_string_type(text.size() + 1);
  write(object, name, type.get(), create_space({}), text.c_str());
}

}  // namespace coordreq::hdf5
