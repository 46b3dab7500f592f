#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/hdf5_handle.hpp"

// Attributes of files, groups and datasets, typed as netCDF-4 has them. `name` must not be there yet.
namespace coordreq::hdf5 {

/// A variable-length UTF-8 string.
void set_attribute(const Handle& object, const std::string& name, const std::string& text);
void set_attribute(const Handle& object, const std::string& name, double value);
void set_attribute(const Handle& object, const std::string& name, std::int32_t value);
void set_attribute(const Handle& object, const std::string& name, std::int64_t value);
void set_attribute(const Handle& object, const std::string& name, std::uint64_t value);
/// An array of `type`, which holds every value. REQUIRES: an integer type.
void set_attribute(const Handle& object, const std::string& name, ElementType type,
                   const std::vector<std::int64_t>& values);

/// A fixed-length ASCII string, as the dimension scale specification wants its own attributes.
void set_ascii_attribute(const Handle& object, const std::string& name, const std::string& text);

}  // namespace coordreq::hdf5
