#include "results/write_results.hpp"

#include <gtest/gtest.h>
#include <hdf5_hl.h>

#include <memory>
#include <stdexcept>

#include "base/error.hpp"
#include "results/hdf5_handle.hpp"
#include "results/sample_content.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

using hdf5::Handle;
using Names = std::vector<std::string>;
using sample::bytes_of;
using sample::Options;
using sample::Sample;
using sample::ScratchFolder;
using Shape = std::vector<hsize_t>;

void write(const std::string& path, const Sample& content, int threads = 2) {
  ThreadTeam team(threads);
  write_results(path, content.spec, content.values, team);
}

Handle open_file(const std::string& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open"};
}

Handle open_dataset(const Handle& file, const std::string& path) {
  return {H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT), H5Dclose, "open"};
}

Shape dimensions_of(const Handle& dataset) {
  return hdf5::shape_of({H5Dget_space(dataset.get()), H5Sclose, "space"});
}

/// All elements, through HDF5's own filters.
std::vector<std::int64_t> elements(const Handle& file, const std::string& path) {
  const Handle dataset = open_dataset(file, path);
  std::size_t count = 1;
  for (const hsize_t length : dimensions_of(dataset)) count *= length;
  std::vector<std::int64_t> values(count);
  EXPECT_GE(H5Dread(dataset.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0)
      << path;
  return values;
}

template <typename Formula>
void expect_elements(const Handle& file, const std::string& path, std::size_t count, Formula formula) {
  const std::vector<std::int64_t> found = elements(file, path);
  ASSERT_EQ(found.size(), count) << path;
  for (std::size_t i = 0; i < count; ++i)
    ASSERT_EQ(found[i], static_cast<std::int64_t>(formula(i))) << path << ' ' << i;
}

bool has_type(const Handle& file, const std::string& path, hid_t expected) {
  const Handle type(H5Dget_type(open_dataset(file, path).get()), H5Tclose, "type");
  return H5Tequal(type.get(), expected) > 0;
}

std::string long_string(const Handle& file, const std::string& object, const std::string& attribute) {
  const Handle handle(
      H5Aopen_by_name(file.get(), object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "attribute");
  const Handle type(H5Aget_type(handle.get()), H5Tclose, "type");
  EXPECT_GT(H5Tis_variable_str(type.get()), 0);
  EXPECT_EQ(H5Tget_cset(type.get()), H5T_CSET_UTF8);
  char* text = nullptr;
  EXPECT_GE(H5Aread(handle.get(), type.get(), &text), 0);
  const std::string result = text;
  H5free_memory(text);
  return result;
}

std::vector<std::int64_t> integers(const Handle& file, const std::string& object,
                                   const std::string& attribute) {
  const Handle handle(
      H5Aopen_by_name(file.get(), object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "attribute");
  const Handle space(H5Aget_space(handle.get()), H5Sclose, "space");
  std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  EXPECT_GE(H5Aread(handle.get(), H5T_NATIVE_INT64, values.data()), 0);
  return values;
}

/// Calls visit(path, object) for every object of the file.
template <typename Visit>
void walk(const Handle& file, Visit visit) {
  const auto step = [](hid_t root, const char* name, const H5O_info_t*, void* data) -> herr_t {
    const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose, "object");
    (*static_cast<Visit*>(data))(std::string(name), object);
    return 0;
  };
  ASSERT_GE(H5Ovisit(file.get(), H5_INDEX_NAME, H5_ITER_INC, step, &visit), 0);
}

class WrittenSample : public testing::Test {
 protected:
  void write_sample(const Options& options) {
    write(folder_ / "sample.h5", sample::make_sample(options));
    file_ = std::make_unique<Handle>(open_file(folder_ / "sample.h5"));
  }
  [[nodiscard]] const Handle& file() const { return *file_; }

 private:
  ScratchFolder folder_;
  std::unique_ptr<Handle> file_;
};

TEST_F(WrittenSample, SetsAndTimesAreThere) {
  const Options options;
  write_sample(options);
  const std::size_t cells = sample::cell_count(options);
  expect_elements(file(), "/safe", cells, [](std::size_t i) { return sample::is_safe(i) ? 1 : 0; });
  expect_elements(file(), "/invariant", cells, [](std::size_t i) { return sample::is_invariant(i) ? 1 : 0; });
  expect_elements(file(), "/collision_time", cells,
                  [](std::size_t i) { return sample::collision_time(i, ElementType::int16); });
  EXPECT_EQ(dimensions_of(open_dataset(file(), "/safe")), (Shape{61, 51, 40}));
}

TEST_F(WrittenSample, DelaysAndTriggersOfAllPartitionsAreThere) {
  for (const ElementType steps : {ElementType::int16, ElementType::int32}) {
    Options options;
    options.steps = steps;
    write_sample(options);
    const std::size_t cells = sample::cell_count(options);
    expect_elements(file(), "/delay", 2 * cells,
                    [=](std::size_t i) { return sample::delay(i / cells, i % cells, steps); });
    expect_elements(file(), "/trigger", 2 * cells,
                    [=](std::size_t i) { return sample::trigger(i / cells, i % cells, steps); });
    const hid_t type = steps == ElementType::int16 ? H5T_STD_I16LE : H5T_STD_I32LE;
    for (const char* path : {"/collision_time", "/delay", "/trigger"})
      EXPECT_TRUE(has_type(file(), path, type));
    EXPECT_EQ(integers(file(), "/delay", "flag_values"),
              (std::vector<std::int64_t>{-2, -1, sample::maximum(steps)}));
    EXPECT_EQ(integers(file(), "/trigger", "flag_values"),
              (std::vector<std::int64_t>{-3, -2, -1, sample::maximum(steps)}));
  }
}

// All partitions then lie in one contiguous dataset, so that a stretch runs over the end of the first.
TEST_F(WrittenSample, SmallArraysHoldAllPartitionsToo) {
  Options options;
  options.points = {3, 2, 1};
  write_sample(options);
  expect_elements(file(), "/delay", 12,
                  [](std::size_t i) { return sample::delay(i / 6, i % 6, ElementType::int16); });
}

TEST_F(WrittenSample, OneChunkMayHoldSeveralPartitions) {
  Options options;
  options.points = {61, 40, 5};  // 12,200 cells of two bytes: both partitions in one chunk
  write_sample(options);
  expect_elements(file(), "/delay", 24400,
                  [](std::size_t i) { return sample::delay(i / 12200, i % 12200, ElementType::int16); });
}

TEST_F(WrittenSample, LayersAreThere) {
  const Options options;
  write_sample(options);
  const auto cells = static_cast<std::int64_t>(sample::cell_count(options));
  EXPECT_EQ(elements(file(), "/layer"), (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(elements(file(), "/layer_size"),
            (std::vector<std::int64_t>{cells / 2, cells / 4, cells / 8, cells / 8,  // constant once fixed
                                       cells / 2, cells / 4, cells / 8, cells / 16}));
  EXPECT_EQ(elements(file(), "/fixed_point_index"), (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(elements(file(), "/layers/alone/start"),
            (std::vector<std::int64_t>{0, cells / 2 - 1, cells / 2 - 1, cells / 2}));
  expect_elements(file(), "/layers/a|b+c/cell", static_cast<std::size_t>(cells) / 2,
                  [](std::size_t i) { return 2 * i; });
  EXPECT_TRUE(has_type(file(), "/layers/alone/cell", H5T_STD_U32LE));
}

TEST_F(WrittenSample, TruncatedLayersRunToTheLastComputed) {
  Options options;
  options.truncated = true;
  write_sample(options);
  EXPECT_EQ(elements(file(), "/fixed_point_index"), (std::vector<std::int64_t>{-1, -1}));
  EXPECT_EQ(elements(file(), "/layer").size(), 4U);
}

TEST_F(WrittenSample, ActionsAreThere) {
  const Options options;
  write_sample(options);
  const std::size_t cells = sample::cell_count(options);
  expect_elements(file(), "/actions/a|b+c/a", cells, sample::action_byte);
  expect_elements(file(), "/actions/a|b+c/b+c", 2 * cells, sample::action_byte);
  expect_elements(file(), "/controller", 10 * cells, sample::action_byte);
  EXPECT_EQ(integers(file(), "/actions/a|b+c/b+c", "actions"), std::vector<std::int64_t>{15});
}

TEST_F(WrittenSample, TablesAreOverWhatTheyDependOn) {
  write_sample({});
  EXPECT_EQ(dimensions_of(open_dataset(file(), "/abstraction/x1/first")), (Shape{61, 5}));
  expect_elements(file(), "/abstraction/x1/last", 305, [](std::size_t i) { return std::int64_t(i) + 3; });
  EXPECT_EQ(dimensions_of(open_dataset(file(), "/abstraction/x2/first")), Shape{});
  EXPECT_EQ(elements(file(), "/abstraction/x2/last"), std::vector<std::int64_t>{9});
}

TEST_F(WrittenSample, WhatWasNotAskedForIsNotThere) {
  Options options;
  options.with_extras = false;
  write_sample(options);
  for (const char* path : {"/layers", "/actions", "/controller", "/abstraction"}) {
    EXPECT_EQ(H5Lexists(file().get(), path, H5P_DEFAULT), 0) << path;
  }
}

TEST_F(WrittenSample, AttributesOfTheFileAreThere) {
  write_sample({});
  EXPECT_EQ(long_string(file(), "/", "filetype"), "coordreq-results");
  EXPECT_EQ(integers(file(), "/", "version"), (std::vector<std::int64_t>{1, 0}));
  EXPECT_EQ(long_string(file(), "/", "title"), "sample");
  EXPECT_EQ(long_string(file(), "/", "Conventions"), "CF-1.10");
  EXPECT_EQ(long_string(file(), "/", "spec_sha256").size(), 64U);
  EXPECT_EQ(long_string(file(), "/", "period_unit"), "s");
  EXPECT_EQ(long_string(file(), "/", "guarantee"), "samples");
  for (const char* name : {"coordreq_version", "git_sha1"}) EXPECT_NE(long_string(file(), "/", name), "");
  EXPECT_GT(H5Aexists(file().get(), "period"), 0);
  EXPECT_EQ(integers(file(), "/trigger", "connection_delay"), std::vector<std::int64_t>{2});
}

TEST_F(WrittenSample, AxesHaveUnitsAndSteps) {
  write_sample({});
  EXPECT_EQ(long_string(file(), "/x1", "units"), "m");
  EXPECT_EQ(long_string(file(), "/x2", "units"), "s");
  EXPECT_EQ(long_string(file(), "/heading", "units"), "1");
  EXPECT_EQ(long_string(file(), "/u1", "units"), "m/s");
  EXPECT_GT(H5Aexists_by_name(file().get(), "/x1", "step", H5P_DEFAULT), 0);
  EXPECT_EQ(H5Aexists_by_name(file().get(), "/u2", "step", H5P_DEFAULT), 0);
}

/// What the first scale of an axis says.
struct Scale {
  hsize_t length = 0;
  bool attached = false;  ///< the lists of both sides agree
};

Scale first_scale(const Handle& dataset, unsigned axis) {
  Scale result;
  const auto take = [](hid_t user, unsigned number, hid_t scale, void* out) -> herr_t {
    const Handle space(H5Dget_space(scale), H5Sclose, "space");
    *static_cast<Scale*>(out) = {hdf5::shape_of(space).at(0), H5DSis_attached(user, scale, number) > 0};
    return 1;
  };
  EXPECT_EQ(H5DSget_num_scales(dataset.get(), axis), 1);
  EXPECT_EQ(H5DSiterate_scales(dataset.get(), axis, nullptr, take, &result), 1);
  return result;
}

TEST_F(WrittenSample, EveryAxisOfEveryDatasetHasADimensionScale) {
  write_sample({});
  int scales = 0;
  int datasets = 0;
  walk(file(), [&](const std::string& path, const Handle& object) {
    if (H5Iget_type(object.get()) != H5I_DATASET) return;
    SCOPED_TRACE(path);
    const Shape shape = dimensions_of(object);
    if (H5DSis_scale(object.get()) > 0) {
      ++scales;
      EXPECT_EQ(shape.size(), 1U);
      return;
    }
    ++datasets;
    for (unsigned axis = 0; axis < shape.size(); ++axis) {
      const Scale scale = first_scale(object, axis);
      EXPECT_EQ(scale.length, shape[axis]) << axis;
      EXPECT_TRUE(scale.attached) << axis;
    }
  });
  EXPECT_EQ(scales, 6 + 2 + 4 + 6);  // states and inputs, partition and layer, lists, bytes
  EXPECT_EQ(datasets, 2 + 7 + 4 + 6 + 6);
}

TEST_F(WrittenSample, NoObjectIsDated) {
  write_sample({});
  int objects = 0;
  walk(file(), [&](const std::string& path, const Handle& object) {
    H5O_info_t info;
    ASSERT_GE(H5Oget_info(object.get(), &info), 0);
    EXPECT_EQ(info.atime + info.mtime + info.ctime + info.btime, 0) << path;
    ++objects;
  });
  EXPECT_GT(objects, 33);
}

TEST_F(WrittenSample, LargeArraysAreChunkedAndCompressedAndSmallOnesAreNot) {
  write_sample({});
  const auto layout_of = [&](const char* path) {
    const Handle list(H5Dget_create_plist(open_dataset(file(), path).get()), H5Pclose, "list");
    return std::pair(H5Pget_layout(list.get()), H5Pget_nfilters(list.get()));
  };
  EXPECT_EQ(layout_of("/delay"), std::pair(H5D_CHUNKED, 2));
  EXPECT_EQ(layout_of("/safe"), std::pair(H5D_CHUNKED, 1));
  EXPECT_EQ(layout_of("/layer_size"), std::pair(H5D_CONTIGUOUS, 0));
}

TEST(WriteResults, BytesDoNotDependOnThreadsOrRun) {
  const ScratchFolder folder;
  // A dozen chunks: one thread packs two of them at a time, five threads ten.
  const Sample content = sample::make_sample({.points = {61, 40, 160}});
  write(folder / "1.h5", content, 1);
  const std::string expected = bytes_of(folder / "1.h5");
  ASSERT_GT(expected.size(), 100000U);
  for (const int threads : {1, 2, 5}) {
    write(folder / "n.h5", content, threads);
    EXPECT_TRUE(bytes_of(folder / "n.h5") == expected) << threads;
  }
}

TEST(WriteResults, TriggersThatEqualDelaysAreReadAsIfWrittenForThemselves) {
  for (const std::uint64_t points :
       {std::uint64_t{61}, std::uint64_t{3}}) {  // in chunks, and too small for any
    Sample content = sample::make_sample({.points = {points, 5, 40}});
    content.values.entries["/trigger"] = content.values.entries["/delay"];
    const ScratchFolder folder;
    write(folder / "twice.h5", content);
    content.values.entries["/trigger"].equals = "/delay";
    write(folder / "once.h5", content);
    const Handle once = open_file(folder / "once.h5");
    EXPECT_EQ(elements(once, "/trigger"), elements(once, "/delay"));
    EXPECT_EQ(bytes_of(folder / "once.h5"), bytes_of(folder / "twice.h5"));
  }
}

TEST(WriteResults, ReplacesOnSuccess) {
  const ScratchFolder folder;
  sample::write_bytes(folder / "a.h5", "old");
  write(folder / "a.h5", sample::make_sample());
  EXPECT_GT(H5Fis_hdf5((folder / "a.h5").c_str()), 0);
  EXPECT_EQ(folder.names(), Names{"a.h5"});
}

TEST(WriteResults, AnExceptionFromAnArrayLeavesTheOldFileAndNothingElse) {
  const ScratchFolder folder;
  sample::write_bytes(folder / "a.h5", "old");
  Sample content = sample::make_sample();
  content.values.entries["/trigger"].array.fill = [](std::uint64_t, std::uint64_t, void*) {
    throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(write(folder / "a.h5", content), std::runtime_error);
  EXPECT_EQ(bytes_of(folder / "a.h5"), "old");
  EXPECT_EQ(folder.names(), Names{"a.h5"});
}

TEST(WriteResults, ValuesThatAFieldCannotHaveAreAProgrammingError) {
  const ScratchFolder folder;
  Sample content = sample::make_sample();
  content.values.entries["/delay"].array.type = ElementType::float32;
  EXPECT_THROW(write(folder / "a.h5", content), std::invalid_argument);
  content = sample::make_sample();
  content.values.entries.erase("/invariant");
  EXPECT_THROW(write(folder / "a.h5", content), std::invalid_argument);
  content = sample::make_sample();
  content.values.lengths.erase("/layer");
  EXPECT_THROW(write(folder / "a.h5", content), std::invalid_argument);
  EXPECT_EQ(folder.names(), Names{});
}

TEST(WriteResults, AMissingFolderIsNamed) {
  const ScratchFolder folder;
  EXPECT_THROW(write(folder / "none/a.h5", sample::make_sample()), IoError);
}

TEST(WriteResults, AnEmptyInvarianceSetHasEmptyLists) {
  const ScratchFolder folder;
  Sample content = sample::make_sample();
  content.values.lengths["/layer"] = 1;
  for (const char* name : {"alone", "a|b+c"}) {
    content.values.lengths[std::string("/layers/") + name + "/bound"] = 2;
    content.values.lengths[std::string("/layers/") + name + "/position"] = 0;
  }
  write(folder / "a.h5", content);
  const Handle file = open_file(folder / "a.h5");
  EXPECT_EQ(dimensions_of(open_dataset(file, "/layers/alone/cell")), Shape{0});
  EXPECT_EQ(elements(file, "/layer"), std::vector<std::int64_t>{0});
}

}  // namespace
}  // namespace coordreq
