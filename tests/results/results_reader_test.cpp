#include "results/results_reader.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <random>

#include "answers/field_table.hpp"
#include "answers/paths.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "base/error.hpp"
#include "base/thread_team.hpp"
#include "results/hdf5_handle.hpp"
#include "results/sample_content.hpp"
#include "results/scratch_folder.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using hdf5::Handle;
using sample::bytes_of;
using sample::write_bytes;

class Reader : public testing::Test {
 protected:
  void write(const sample::Options& options = {.points = sample::kFewPoints}) {
    sample::write_sample(path_, options);
  }

  /// Changes the file behind the back of the program.
  void damage(const std::function<void(const Handle& file)>& change) {
    const Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    change(file);
  }

  void overwrite(const std::string& dataset, hid_t type, const void* values) {
    damage([=](const Handle& file) {
      const Handle object = hdf5::open_object(file, dataset);
      hdf5::check(H5Dwrite(object.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write");
    });
  }

  /// The error of `use`, with FILE for the path; empty if there is none.
  [[nodiscard]] std::string defect(const std::function<void(const ResultsReader&)>& use = {}) const {
    try {
      const ResultsReader results(path_);
      if (use) use(results);
    } catch (const ResultsError& error) {
      std::string text = error.what();
      for (auto at = text.find(path_); at != std::string::npos; at = text.find(path_)) {
        text.replace(at, path_.size(), "FILE");
      }
      return text;
    }
    return "";
  }

  sample::ScratchFolder folder_;
  std::string path_ = folder_ / "sample.h5";
};

TEST_F(Reader, TellsTheSpecAndTheAttributes) {
  write();
  const ResultsReader results(path_);
  const sample::Options options{.points = sample::kFewPoints};
  EXPECT_EQ(results.path(), path_);
  EXPECT_EQ(results.spec().text, sample::spec_text(options));
  EXPECT_EQ(results.grid().cells(), 120);
  EXPECT_EQ(results.grid()[1].name, "x2");
  EXPECT_EQ(results.inputs().count(), 75);
  const StoredAttributes& attributes = results.attributes();
  EXPECT_EQ(attributes.title, "sample");
  EXPECT_EQ(attributes.conventions, "CF-1.10");
  EXPECT_EQ(attributes.guarantee, "samples");
  EXPECT_EQ(attributes.period, 0.25);
  EXPECT_EQ(attributes.period_unit, "s");
  EXPECT_EQ(attributes.safe_cells, sample::count_cells(options, sample::is_safe));
  EXPECT_EQ(attributes.invariant_cells, sample::count_cells(options, sample::is_invariant));
  EXPECT_EQ(attributes.iterations, 12);
  EXPECT_EQ(attributes.connection_delay, 2);
  EXPECT_EQ(attributes.spec_sha256.size(), 64U);
}

TEST_F(Reader, TellsThePartitions) {
  write();
  const ResultsReader results(path_);
  ASSERT_EQ(results.partitions().size(), 2U);
  const StoredPartition& alone = results.partitions()[0];
  EXPECT_EQ(alone.name, "alone");
  EXPECT_EQ(alone.classes, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(alone.actions, (std::vector<std::int64_t>{5, 3, 5}));
  EXPECT_EQ(alone.fixed_point_index, 2);
  EXPECT_EQ(alone.layer_sizes, (std::vector<std::uint64_t>{60, 30, 15}));
  EXPECT_EQ(alone.padded_sizes, (std::vector<std::uint64_t>{60, 30, 15, 15}));
  const StoredPartition& pair = results.partitions()[1];
  EXPECT_EQ(pair.name, "a|b+c");
  EXPECT_EQ(pair.classes, (std::vector<std::string>{"a", "b+c"}));
  EXPECT_EQ(pair.actions, (std::vector<std::int64_t>{5, 15}));
  EXPECT_EQ(pair.layer_sizes.size(), 4U);
  EXPECT_FALSE(pair.truncated());
}

TEST_F(Reader, ATruncatedPartitionHasAllItsLayers) {
  write({.points = {6, 5, 4}, .truncated = true, .with_extras = false});
  const ResultsReader results(path_);
  EXPECT_TRUE(results.partitions()[1].truncated());
  EXPECT_EQ(results.partitions()[1].layer_sizes.size(), 4U);
}

/// Every array over cells in a block, against the formulas.
void expect_block(const ResultsReader& results, const CellBlock& block, ElementType steps) {
  const auto cells = static_cast<std::size_t>(block.cells());
  const auto safe = results.members("/safe", block);
  const auto invariant = results.members("/invariant", block);
  const auto times = results.values("/collision_time", block);
  const auto delay = results.values("/delay", 1, block);
  const auto trigger = results.values("/trigger", 1, block);
  ASSERT_EQ(safe.size(), cells);
  ASSERT_EQ(trigger.size(), cells);
  const auto widened = [steps](std::int64_t value) {
    return value == sample::maximum(steps) ? kUnbounded : value;
  };
  std::size_t position = 0;
  for (std::int64_t i = 0; i < block.count[0]; ++i) {
    for (std::int64_t j = 0; j < block.count[1]; ++j) {
      for (std::int64_t k = 0; k < block.count[2]; ++k, ++position) {
        const UniformGrid& grid = results.grid();
        const auto x = static_cast<std::uint64_t>((block.first[0] + i) * grid.stride(0) +
                                                  (block.first[1] + j) * grid.stride(1) + block.first[2] + k);
        EXPECT_EQ(safe[position], sample::is_safe(x));
        EXPECT_EQ(invariant[position], sample::is_invariant(x));
        EXPECT_EQ(times[position], widened(sample::collision_time(x, steps)));
        EXPECT_EQ(delay[position], widened(sample::delay(1, x, steps)));
        EXPECT_EQ(trigger[position], widened(sample::trigger(1, x, steps)));
      }
    }
  }
}

TEST_F(Reader, BlocksHoldWhatWasWritten) {
  for (const ElementType steps : {ElementType::int16, ElementType::int32}) {
    // The large one is stored in many chunks.
    for (const std::vector<std::uint64_t>& points :
         {std::vector<std::uint64_t>{6, 5, 4}, std::vector<std::uint64_t>{33, 51, 40}}) {
      write({.points = points, .steps = steps, .with_extras = false});
      const ResultsReader results(path_);
      expect_block(results, all_cells(results.grid()), steps);
      expect_block(results, one_cell(results.grid(), 0), steps);
      expect_block(results, one_cell(results.grid(), results.grid().cells() - 1), steps);
      expect_block(results, {{2, 1, 3}, {3, 4, 1}}, steps);
      EXPECT_TRUE(results.members("/safe", {{0, 0, 0}, {2, 0, 3}}).empty());
    }
  }
}

TEST_F(Reader, AStretchIsTheCellsInTheirOrder) {
  write();
  const ResultsReader results(path_);
  for (const auto& [begin, end] : {std::pair<std::int64_t, std::int64_t>{0, 120}, {7, 113}, {5, 6}, {9, 9}}) {
    const auto delays =
        results.read_run(begin, end, [&](const CellBlock& b) { return results.values("/delay", 0, b); });
    ASSERT_EQ(static_cast<std::int64_t>(delays.size()), end - begin);
    for (std::int64_t x = begin; x < end; ++x) {
      const std::int64_t value = sample::delay(0, static_cast<std::uint64_t>(x), ElementType::int16);
      EXPECT_EQ(delays[static_cast<std::size_t>(x - begin)], value == 32767 ? kUnbounded : value);
    }
  }
}

StoredLayers layer_lists(const ResultsReader& results) {
  return read_layer_lists(results.spec(), results.spec().coordination.partitions.front(), results);
}

TEST_F(Reader, WhatIsStoredOnRequest) {
  write();
  const ResultsReader results(path_);
  for (const char* const path : {"/actions/alone/a", "/actions/a|b+c/a", "/controller", "/layers/alone/cell"})
    ASSERT_TRUE(results.has(path)) << path;
  const CellBlock cell = one_cell(results.grid(), 77);
  EXPECT_EQ(results.bits("/actions/a|b+c/a", cell), std::vector<std::uint8_t>{sample::action_byte(77)});
  EXPECT_EQ(results.bits("/actions/a|b+c/b+c", all_cells(results.grid())).size(), 240U);
  std::vector<std::uint8_t> expected;
  for (std::uint64_t i = 770; i < 780; ++i) expected.push_back(sample::action_byte(i));
  EXPECT_EQ(results.bits("/controller", cell), expected);
  const StoredLayers layers = layer_lists(results);
  EXPECT_EQ(layers.start, (std::vector<std::uint64_t>{0, 59, 59, 60}));
  ASSERT_EQ(layers.cell.size(), 60U);
  EXPECT_EQ(layers.cell[21], 42U);
}

TEST_F(Reader, TheAbstraction) {
  write();
  const ResultsReader results(path_);
  ASSERT_TRUE(results.has_abstraction());
  const Abstraction abstraction = results.abstraction();
  EXPECT_EQ(abstraction.tables[2].states, std::vector<std::int32_t>{2});
  EXPECT_EQ(abstraction.tables[2].inputs, (std::vector<std::int32_t>{1, 2}));
  // Cell (3, 1, 2) and inputs (4, 2, 1).
  const std::int64_t x = 3 * 20 + 1 * 4 + 2;
  const std::int64_t u = 4 * 15 + 2 * 5 + 1;
  EXPECT_EQ(abstraction.raw(0, x, u), (IndexRange{3 * 5 + 4 - 3, 3 * 5 + 4 + 3}));
  EXPECT_EQ(abstraction.raw(1, x, u), (IndexRange{7, 9}));
  EXPECT_EQ(abstraction.raw(2, x, u), (IndexRange{2 * 15 + 11 - 9, 2 * 15 + 11}));
}

TEST_F(Reader, NothingMoreThanWasAskedFor) {
  write({.points = {6, 5, 4}, .with_extras = false});
  const ResultsReader results(path_);
  for (const char* const path : {"/actions/a|b+c/a", "/controller", "/layers/a|b+c/cell"})
    EXPECT_FALSE(results.has(path)) << path;
  EXPECT_FALSE(results.has_abstraction());
}

TEST_F(Reader, WhatCannotBeReadIsAnInputError) {
  EXPECT_THROW(ResultsReader{path_}, IoError);
  EXPECT_THROW(ResultsReader{"/dev/null"}, IoError);
}

TEST_F(Reader, OtherFilesAreNotResults) {
  write_bytes(path_, "x1,x2\n1,2\n");
  EXPECT_EQ(defect(), "not a coordreq results file: it is not HDF5, or cut short (FILE)");
}

TEST_F(Reader, ASpecThatIsNotTheOneAnalysedIsRefused) {
  write();
  damage([](const Handle& file) {
    H5Adelete_by_name(file.get(), "/", "spec_sha256", H5P_DEFAULT);
    hdf5::set_attribute(hdf5::open_object(file, "/"), "spec_sha256", std::string("0123"));
  });
  EXPECT_NE(defect().find(", the attribute spec_sha256 says 0123 (FILE:/spec)"), std::string::npos)
      << defect();
  sample::Sample content = sample::make_sample({.points = sample::kFewPoints});
  content.spec.text = "{}";
  ThreadTeam team(1);
  write_results(path_, content.spec, content.values, team);
  EXPECT_NE(defect().find("the spec is not valid: "), std::string::npos) << defect();
}

TEST_F(Reader, AFileThatDoesNotFitItsSpecIsRefused) {
  write();
  std::vector<double> points = {-1, -0.875, -0.75 + 1e-9, -0.625, -0.5, -0.375};
  overwrite("/x1", H5T_NATIVE_DOUBLE, points.data());
  EXPECT_EQ(defect(), "grid point 2 is not that of the spec (FILE:/x1)");
  sample::Sample content = sample::make_sample({.points = sample::kFewPoints, .with_extras = false});
  content.spec.coordination.partitions[1].name = "b+c|a";
  ThreadTeam team(1);
  write_results(path_, content.spec, content.values, team);
  EXPECT_EQ(defect(), "the names are not those of the spec (FILE:/partition)");
  write();
  damage([](const Handle& file) {
    const Handle bits = hdf5::open_object(file, "/actions/a|b+c/b+c");
    hdf5::check(H5Adelete(bits.get(), "actions"), "delete");
    hdf5::set_attribute(bits, "actions", std::uint64_t{5});
  });
  EXPECT_EQ(defect(), "the attribute actions is 5, expected 15 (FILE:/actions/a|b+c/b+c)");
}

TEST_F(Reader, AnAttributeThatIsNoFiniteNumberIsRefused) {
  write();
  damage([](const Handle& file) {
    H5Adelete_by_name(file.get(), "/", "period", H5P_DEFAULT);
    hdf5::set_attribute(hdf5::open_object(file, "/"), "period", std::numeric_limits<double>::quiet_NaN());
  });
  EXPECT_EQ(defect(), "the attribute period is not a finite number (FILE:/)");
}

TEST_F(Reader, EveryFieldThatTheSpecAsksForMustBeThere) {
  const sample::Options options{.points = sample::kFewPoints, .with_everything = true};
  write(options);
  std::vector<std::string> paths;
  auto whole = std::make_optional<ResultsReader>(path_);
  for (const Field& field : result_fields(sample::make_sample(options).spec)) {
    const bool may_miss = field.scale && (field.scale->is_optional || field.path.ends_with("state_name"));
    if (!may_miss && whole->has(field.path)) paths.push_back(field.path);
  }
  whole.reset();  // HDF5 lets nobody change a file that is being read
  for (const std::string& path : paths) {
    write(options);
    damage(
        [&](const Handle& file) { hdf5::check(H5Ldelete(file.get(), path.c_str(), H5P_DEFAULT), "delete"); });
    EXPECT_EQ(defect(), "missing or damaged (FILE:" + path + ")");
  }
}

TEST_F(Reader, EverythingThatWasWrittenIsRead) {
  write({.points = sample::kFewPoints, .with_everything = true});
  const ResultsReader results(path_);
  EXPECT_EQ(results.attributes().controller_sha256, "0123");
  EXPECT_EQ(results.counted(paths::kCoalition), (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(results.counted(paths::kCriticalPair), (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_EQ(results.counted(paths::kNetworkSafe).size(), results.spec().network->modes.size());
  const std::vector<ResultRequirement> found = read_requirement_values(results.spec(), results);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].holds);
  ASSERT_TRUE(found[0].path);
  EXPECT_EQ(found[0].path->samples(), 3U);
  EXPECT_EQ(found[0].path->steps(), 2U);
  EXPECT_FALSE(found[1].path);
}

TEST_F(Reader, ValuesThatMeanNothingAreRefused) {
  write();
  std::vector<std::int32_t> values(240, 0);
  values[200] = 2;
  overwrite("/safe", H5T_NATIVE_INT32, values.data());
  EXPECT_EQ(defect(), "");
  overwrite("/safe", H5T_NATIVE_INT32, values.data() + 100);
  EXPECT_EQ(
      defect([](const ResultsReader& r) { static_cast<void>(r.members("/safe", all_cells(r.grid()))); }),
      "a value other than 0 and 1: damaged (FILE:/safe)");
  values[200] = -3;
  overwrite("/delay", H5T_NATIVE_INT32, values.data());
  EXPECT_EQ(
      defect([](const ResultsReader& r) { static_cast<void>(r.values("/delay", 0, all_cells(r.grid()))); }),
      "");
  EXPECT_EQ(
      defect([](const ResultsReader& r) { static_cast<void>(r.values("/delay", 1, all_cells(r.grid()))); }),
      "found -3, expected at least -2 (FILE:/delay)");
  std::vector<std::uint64_t> starts = {0, 9, 8, 60};
  overwrite("/layers/alone/start", H5T_NATIVE_UINT64, starts.data());
  EXPECT_EQ(defect([](const ResultsReader& r) { static_cast<void>(layer_lists(r)); }),
            "does not ascend from 0 to the number of cells (FILE:/layers/alone/start)");
}

TEST_F(Reader, AnotherElementTypeIsRefused) {
  write();
  damage([](const Handle& file) {
    hdf5::check(H5Ldelete(file.get(), "/delay", H5P_DEFAULT), "delete");
    static_cast<void>(hdf5::create_dataset(file, "/delay", H5T_IEEE_F64LE, hdf5::create_space({2, 6, 5, 4})));
  });
  EXPECT_EQ(defect(), "elements of another type than int16 and int32 (FILE:/delay)");
}

/// Everything that can be read.
void read_all(const ResultsReader& results) {
  const CellBlock cells = all_cells(results.grid());
  for (const Field& field : results.fields()) {
    const std::size_t entries = results.leading_length(field);
    if (field.kind == FieldKind::actions) static_cast<void>(results.bits(field, cells));
    if (field.kind != FieldKind::set && field.kind != FieldKind::steps) continue;
    if (entries == 0) static_cast<void>(results.values(field, std::nullopt, cells));
    for (std::size_t i = 0; i < entries; ++i) static_cast<void>(results.values(field, i, cells));
  }
  for (const PartitionSpec& partition : results.spec().coordination.partitions) {
    if (results.has(paths::layers(partition) + "/cell"))
      static_cast<void>(read_layer_lists(results.spec(), partition, results));
  }
  if (results.has_abstraction()) static_cast<void>(results.abstraction());
}

TEST_F(Reader, FlippedBitsAreErrorsOrGoUnnoticedButCrashNothing) {
  write({.points = {6, 30, 40}});
  const std::string whole = bytes_of(path_);
  std::mt19937_64 random(20180410);  // NOLINT: the same flips each time
  int errors = 0;
  for (int i = 0; i < 50; ++i) {
    std::string bytes = whole;
    char& byte = bytes[random() % bytes.size()];
    byte = static_cast<char>(byte ^ 1 << random() % 8);
    write_bytes(path_, bytes);
    try {
      read_all(ResultsReader(path_));
    } catch (const Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 0);
}

TEST_F(Reader, TheListsOfStringsAreTriedInAChild) {
  // The heap of strings: with sizes and numbers in it turned over the library itself crashes.
  write();
  const std::string whole = bytes_of(path_);
  const std::size_t heap = whole.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  for (std::size_t offset = 4; offset < 80; ++offset) {
    std::string bytes = whole;
    bytes[heap + offset] = static_cast<char>(~bytes[heap + offset]);
    write_bytes(path_, bytes);
    try {
      read_all(ResultsReader(path_));
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::invalid_input) << error.what();
    }
  }
}

}  // namespace
}  // namespace coordreq
