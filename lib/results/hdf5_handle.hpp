#pragma once

#include <hdf5.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "answers/field.hpp"

// Ownership of HDF5 identifiers. Every identifier of the program is held by a Handle; other files of this
// module pass Handle::get() to the library and keep nothing.
//
// Thread safety: none; the HDF5 library may be built without it. One thread at a time uses any of this.
namespace coordreq::hdf5 {

class OutputDriver;

/// A call of the HDF5 library failed. Stays inside this module: it becomes an IoError when writing and a
/// ResultsError when reading, which name the file.
class Failure : public std::runtime_error {
 public:
  Failure(const std::string& what, int system_error)
      : std::runtime_error(what), system_error_(system_error) {}

  /// errno of the system call beneath, 0 if there was none.
  [[nodiscard]] int system_error() const { return system_error_; }

 private:
  int system_error_;
};

/// Keeps the library from printing its errors while it lives; they become Failures instead.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns one identifier. Moving leaves the source empty.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// @param what names the object for the message
  /// @throws Failure if `id` is negative, which is how the library says that it could not open or create it
  Handle(hid_t id, Close close_function, std::string_view what);
  ~Handle();
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  [[nodiscard]] hid_t get() const { return id_; }

  /// Closes now, so that a failure is noticed. @throws Failure
  void close(std::string_view what);

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// @throws Failure "cannot <what>" with the system's reason if `status` is negative
void check(herr_t status, std::string_view what);

/// To be called before much is written: what the library does when it is refused memory is not always to say
/// so. @throws std::bad_alloc if addresses are limited and next to none are left
void expect_memory();

/// A new file in which nothing depends on time or on the library's version: format of HDF5 1.8, no times,
/// links and attributes kept in the order of their creation, as netCDF-4 wants. The path must lead to a file,
/// whose content is lost.
[[nodiscard]] Handle create_file(const std::string& path, OutputDriver& driver);
/// Read only.
[[nodiscard]] Handle open_file(const std::string& path);
/// A folder of the file; its parent must be there.
[[nodiscard]] Handle create_group(const Handle& file, const std::string& path);
[[nodiscard]] Handle open_object(const Handle& file, const std::string& path);

/// How the elements of a new dataset are stored.
struct Storage {
  std::vector<hsize_t> chunk;  ///< contiguous if empty
  int deflate_level = 0;       ///< of the filter; used if chunked
  bool shuffle = false;
};
[[nodiscard]] Handle create_dataset(const Handle& file, const std::string& path, hid_t type,
                                    const Handle& space, const Storage& storage = {});

/// A scalar space if `shape` is empty.
[[nodiscard]] Handle create_space(const std::vector<hsize_t>& shape);
[[nodiscard]] Handle create_attribute(const Handle& object, const std::string& name, hid_t type,
                                      const Handle& space);
/// Variable-length UTF-8.
[[nodiscard]] Handle string_type();
/// How to read and write them: the library converts them in two buffers, which by default it makes, and fills
/// with zeros, of 1 MiB each for however little.
[[nodiscard]] Handle text_transfer();
/// ASCII of fixed length, ending in a zero: what the dimension scale specification asks for.
[[nodiscard]] Handle fixed_string_type(std::size_t size);
/// A type in the file and in memory alike; little-endian.
[[nodiscard]] hid_t number_type(ElementType type);

/// Variable-length strings.
[[nodiscard]] bool holds_long_strings(const Handle& type);

/// Strings that the library makes when it reads into data(), and that it owns.
class LibraryStrings {
 public:
  LibraryStrings(const Handle& type, const Handle& space, std::uint64_t count)
      : type_(type), space_(space), texts_(count) {}
  ~LibraryStrings();
  LibraryStrings(const LibraryStrings&) = delete;
  LibraryStrings& operator=(const LibraryStrings&) = delete;

  [[nodiscard]] char** data() { return texts_.data(); }
  [[nodiscard]] std::vector<std::string> copy() const;

 private:
  const Handle& type_;
  const Handle& space_;
  std::vector<char*> texts_;
};

/// Lengths of all dimensions of a dataset or an attribute's space.
[[nodiscard]] std::vector<hsize_t> shape_of(const Handle& space);

// Attributes of files, groups and datasets, typed as netCDF-4 has them. `name` must not be there yet.

/// A variable-length UTF-8 string.
void set_attribute(const Handle& object, const std::string& name, const std::string& text);
void set_attribute(const Handle& object, const std::string& name, double value);
void set_attribute(const Handle& object, const std::string& name, std::int32_t value);
void set_attribute(const Handle& object, const std::string& name, std::int64_t value);
void set_attribute(const Handle& object, const std::string& name, std::uint64_t value);
/// An array of `type`, which holds every value. @pre an integer type
void set_attribute(const Handle& object, const std::string& name, ElementType type,
                   const std::vector<std::int64_t>& values);

/// A fixed-length ASCII string, as the dimension scale specification wants its own attributes.
void set_ascii_attribute(const Handle& object, const std::string& name, const std::string& text);

}  // namespace coordreq::hdf5
