#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "results/array_writer.hpp"
#include "results/hdf5_handle.hpp"
#include "results/output_driver.hpp"

namespace coordreq {

/// Writes an HDF5 file that is a netCDF-4 file: every axis of every dataset has a dimension scale.
///
/// 1. A *dimension* is a dataset that is a scale; "with coordinates" if it holds the axis' values, else only
///    its length means something and nothing is stored.
/// 2. All paths start with "/"; the groups in them are made as needed. A dataset may use the dimensions of
///    its own group and of those around it.
/// 3. The file is complete after finish(), and only then.
///
/// The lists that tie datasets and scales together are written here and not by the high-level HDF5 library:
/// that leaves the padding of its records uninitialised, which would make files differ from run to run, and
/// rewrites a list for each entry.
class NetcdfWriter {
 public:
  /// @param ranks as for ArrayWriter
  /// @throws hdf5::Failure, as all functions here
  NetcdfWriter(const std::string& path, ThreadTeam& team, RankChunks* ranks = nullptr);

  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  [[nodiscard]] const hdf5::Handle& file() const { return file_; }

  /// A dimension without coordinates.
  void add_dimension(const std::string& path, std::uint64_t length);
  /// A dimension with coordinates; returns its dataset for attributes.
  hdf5::Handle add_coordinates(const std::string& path, std::uint64_t length, const ResultArray& array);
  hdf5::Handle add_coordinates(const std::string& path, const std::vector<std::string>& texts);

  /// A dataset with dimensions, named by their paths; none for a scalar.
  hdf5::Handle add_array(const std::string& path, const std::vector<std::string>& dimensions,
                         const ResultArray& array);
  /// add_array() for an array that is known to equal that of `original`, with the same dimensions.
  hdf5::Handle add_copy(const std::string& path, const std::vector<std::string>& dimensions,
                        const ResultArray& array, const hdf5::Handle& original);
  hdf5::Handle add_text(const std::string& path, const std::string& text);

  /// Ties scales to their datasets, and flushes and closes the file.
  void finish();

 private:
  /// An axis of a dataset that a dimension is used for.
  struct Use {
    std::string dataset;
    std::int32_t axis = 0;
  };
  struct Dimension {
    std::uint64_t length = 0;
    std::vector<Use> uses;
  };

  void make_groups(const std::string& path);
  [[nodiscard]] std::vector<hsize_t> shape_of(const std::vector<std::string>& dimensions) const;
  void make_scale(const hdf5::Handle& dataset, const std::string& path, std::uint64_t length,
                  const std::string& name);
  void attach(const hdf5::Handle& dataset, const std::string& path,
              const std::vector<std::string>& dimensions);
  [[nodiscard]] hobj_ref_t reference_to(const std::string& path) const;
  void write_uses(const std::string& path, const Dimension& dimension) const;

  hdf5::OutputDriver driver_;  // outlives the file
  hdf5::Handle file_;
  ArrayWriter arrays_;
  std::map<std::string, Dimension> dimensions_;  // by path
};

}  // namespace coordreq
