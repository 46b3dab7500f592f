// The arrays of a results file.

#include <algorithm>

#include "base/error.hpp"
#include "results/results_file.hpp"

namespace coordreq {
namespace {

std::string in_brackets(const std::vector<std::uint64_t>& shape) {
  std::string text = "[";
  for (const std::uint64_t length : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(length);
  return text + "]";
}

const char* name_of(ElementType type) {
  switch (type) {
    case ElementType::uint8:
      return "uint8";
    case ElementType::int16:
      return "int16";
    case ElementType::int32:
      return "int32";
    case ElementType::uint32:
      return "uint32";
    case ElementType::int64:
      return "int64";
    case ElementType::uint64:
      return "uint64";
    case ElementType::float32:
      return "float32";
    case ElementType::float64:
      break;
  }
  return "float64";
}

template <class Stored, class Value>
std::vector<Value> widened(const std::vector<std::byte>& bytes) {
  const auto* const first = reinterpret_cast<const Stored*>(bytes.data());
  std::vector<Value> values(bytes.size() / sizeof(Stored));
  std::transform(first, first + values.size(), values.begin(),
                 [](Stored value) { return static_cast<Value>(value); });
  return values;
}

template <class Value>
std::vector<Value> widened(ElementType type, const std::vector<std::byte>& bytes) {
  switch (type) {
    case ElementType::uint8:
      return widened<std::uint8_t, Value>(bytes);
    case ElementType::int16:
      return widened<std::int16_t, Value>(bytes);
    case ElementType::int32:
      return widened<std::int32_t, Value>(bytes);
    case ElementType::uint32:
      return widened<std::uint32_t, Value>(bytes);
    case ElementType::int64:
      return widened<std::int64_t, Value>(bytes);
    case ElementType::uint64:
      return widened<std::uint64_t, Value>(bytes);
    case ElementType::float32:
      return widened<float, Value>(bytes);
    case ElementType::float64:
      break;
  }
  return widened<double, Value>(bytes);
}

}  // namespace

const StoredArray& ResultsFile::array(const std::string& path) const {
  const auto known = arrays_.find(path);
  if (known != arrays_.end()) return known->second;
  hdf5::Handle object = open(path);
  if (H5Iget_type(object.get()) != H5I_DATASET) throw ResultsError("not a dataset", location(path));
  return arrays_.emplace(path, StoredArray(std::move(object), bytes_, location(path))).first->second;
}

std::vector<std::uint64_t> ResultsFile::shape(const std::string& dataset) const {
  return array(dataset).shape();
}

void ResultsFile::expect_shape(const std::string& dataset, const std::vector<std::uint64_t>& expected) const {
  const std::vector<std::uint64_t>& found = array(dataset).shape();
  if (found == expected) return;
  throw ResultsError("wrong shape: found " + in_brackets(found) + ", expected " + in_brackets(expected),
                     location(dataset));
}

void ResultsFile::expect_array(const std::string& dataset, const std::vector<ElementType>& types,
                               const std::vector<std::uint64_t>& shape) const {
  expect_shape(dataset, shape);
  const StoredArray& found = array(dataset);
  if (types.empty()) {
    const hdf5::Handle type(H5Dget_type(found.dataset().get()), H5Tclose, "read a type");
    if (!hdf5::holds_long_strings(type) || !found.is_contiguous())
      throw ResultsError("not variable-length strings", location(dataset));
  } else if (!found.type() || std::find(types.begin(), types.end(), *found.type()) == types.end()) {
    std::string names;
    for (const ElementType type : types) names += (names.empty() ? "" : " and ") + std::string(name_of(type));
    throw ResultsError("elements of another type than " + names, location(dataset));
  }
  found.check_storage();
}

ElementType ResultsFile::element_type(const std::string& dataset) const {
  if (const std::optional<ElementType> type = array(dataset).type()) return *type;
  throw ResultsError("elements of an unknown type", location(dataset));
}

void ResultsFile::read_block(const std::string& dataset, ElementType type,
                             const std::vector<std::uint64_t>& offset,
                             const std::vector<std::uint64_t>& count, void* out) const {
  if (element_type(dataset) != type) throw ResultsError("elements of another type", location(dataset));
  array(dataset).read(offset, count, out, cache_);
}

template <typename Value>
std::vector<Value> ResultsFile::elements(const std::string& dataset) const {
  const StoredArray& stored = array(dataset);
  const ElementType type = element_type(dataset);
  std::vector<std::byte> bytes(stored.elements() * element_size(type));
  stored.read(std::vector<std::uint64_t>(stored.shape().size(), 0), stored.shape(), bytes.data(), cache_);
  return widened<Value>(type, bytes);
}

std::vector<double> ResultsFile::numbers(const std::string& dataset) const {
  return elements<double>(dataset);
}

std::vector<std::int64_t> ResultsFile::integers(const std::string& dataset) const {
  return elements<std::int64_t>(dataset);
}

std::vector<std::uint64_t> ResultsFile::naturals(const std::string& dataset) const {
  return elements<std::uint64_t>(dataset);
}

std::vector<double> ResultsFile::numbers(const std::string& dataset, std::uint64_t begin,
                                         std::uint64_t count) const {
  std::vector<double> values(count);
  read_block(dataset, ElementType::float64, {begin}, {count}, values.data());
  return values;
}

std::vector<std::string> ResultsFile::texts(const std::string& dataset) const {
  const StoredArray& stored = array(dataset);
  const hdf5::Handle space(H5Dget_space(stored.dataset().get()), H5Sclose, "read a shape");
  const hdf5::Handle type(H5Dget_type(stored.dataset().get()), H5Tclose, "read a type");
  hdf5::LibraryStrings strings(type, space, stored.elements());
  try {  // or there is no memory for them
    hdf5::check(H5Dread(stored.dataset().get(), type.get(), H5S_ALL, H5S_ALL, hdf5::text_transfer().get(),
                        strings.data()),
                "read the strings");
  } catch (const hdf5::Failure&) {
    throw ResultsError("cannot read the strings: damaged", location(dataset));
  }
  return strings.copy();
}

}  // namespace coordreq
