// Parts of large arrays.

#include <utility>

#include "base/error.hpp"
#include "results/results_file.hpp"

namespace coordreq {
namespace {

/// Unpacked chunks, of at most 1 MiB, that are kept of each dataset: single cells are asked for in any order.
constexpr std::size_t kCacheBytes = 32U << 20U;
constexpr std::size_t kCacheSlots = 3203;  // prime, about 100 a chunk, as the library's manual says

}  // namespace

bool ResultsFile::exists(const std::string& path) const {
  // The library wants every group on the way to be there.
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    if (H5Lexists(file_.get(), path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT) > 0;
}

const ResultsFile::OpenDataset& ResultsFile::open_for_parts(const std::string& path) const {
  const auto known = open_.find(path);
  if (known != open_.end()) return known->second;
  static_cast<void>(open_dataset(path));  // says what is wrong with it better than the library
  const hdf5::Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, "create a property list");
  hdf5::check(H5Pset_chunk_cache(access.get(), kCacheSlots, kCacheBytes, H5D_CHUNK_CACHE_W0_DEFAULT),
              "set the chunk cache");
  hdf5::Handle dataset(H5Dopen2(file_.get(), path.c_str(), access.get()), H5Dclose, "open " + path);
  const hdf5::Handle stored(H5Dget_type(dataset.get()), H5Tclose, "read a type");
  for (const ElementType type :
       {ElementType::uint8, ElementType::int16, ElementType::int32, ElementType::uint32, ElementType::uint64,
        ElementType::float32, ElementType::float64}) {
    if (H5Tequal(stored.get(), hdf5::number_type(type)) <= 0) continue;
    return open_.emplace(path, OpenDataset{std::move(dataset), type}).first->second;
  }
  throw ResultsError("elements of an unknown type", place(path));
}

ElementType ResultsFile::element_type(const std::string& dataset) const {
  return open_for_parts(dataset).type;
}

void ResultsFile::read_block(const std::string& dataset, ElementType type,
                             const std::vector<std::uint64_t>& offset,
                             const std::vector<std::uint64_t>& count, void* out) const {
  const OpenDataset& open = open_for_parts(dataset);
  if (open.type != type) throw ResultsError("elements of another type", place(dataset));
  const hdf5::Handle stored(H5Dget_space(open.dataset.get()), H5Sclose, "read a shape");
  const std::vector<hsize_t> start(offset.begin(), offset.end());
  const std::vector<hsize_t> lengths(count.begin(), count.end());
  const hdf5::Handle wanted = hdf5::create_space(lengths);
  // A scalar has no hyperslabs.
  if (!start.empty()) {
    hdf5::check(
        H5Sselect_hyperslab(stored.get(), H5S_SELECT_SET, start.data(), nullptr, lengths.data(), nullptr),
        "select a part of " + dataset);
  }
  if (H5Dread(open.dataset.get(), hdf5::number_type(type), wanted.get(), stored.get(), H5P_DEFAULT, out) <
      0) {
    throw ResultsError("cannot read the numbers: damaged", place(dataset));
  }
}

}  // namespace coordreq
