#include "results/read_info.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/thread_team.hpp"
#include "results/hdf5_handle.hpp"
#include "results/sample_content.hpp"
#include "results/scratch_folder.hpp"
#include "results/version.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

using hdf5::Handle;
using sample::bytes_of;
using sample::ScratchFolder;
using sample::write_bytes;

class ReadInfo : public testing::Test {
 protected:
  void write_sample(const sample::Options& options = {}) { sample::write_sample(path_, options); }

  /// Changes the file behind the back of the program.
  void damage(const std::function<void(const Handle& file)>& change) {
    const Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    change(file);
  }

  /// The error of read_info(), without the path.
  [[nodiscard]] std::string defect() const {
    try {
      static_cast<void>(read_info(ResultsReader(path_)));
    } catch (const ResultsError& error) {
      std::string text = error.what();
      for (auto place = text.find(path_); place != std::string::npos; place = text.find(path_)) {
        text.replace(place, path_.size(), "FILE");
      }
      return text;
    }
    return "";
  }

  ScratchFolder folder_;
  std::string path_ = folder_ / "sample.h5";
};

void remove(const Handle& file, const std::string& path) {
  hdf5::check(H5Ldelete(file.get(), path.c_str(), H5P_DEFAULT), "delete");
}

void remove_attribute(const Handle& file, const std::string& path, const std::string& name) {
  hdf5::check(H5Adelete_by_name(file.get(), path.c_str(), name.c_str(), H5P_DEFAULT), "delete");
}

TEST_F(ReadInfo, TellsWhatWasWritten) {
  write_sample();
  const Json info = read_info(ResultsReader(path_));
  EXPECT_EQ(info["file"], path_);
  EXPECT_EQ(info["name"], "sample");
  EXPECT_EQ(info["coordreq_version"], program_version());
  EXPECT_EQ(info["git_sha1"], program_git_sha1());
  EXPECT_EQ(info["spec_sha256"].get<std::string>().size(), 64U);
  EXPECT_EQ(info["guarantee"], "samples");
  EXPECT_EQ(info["period"], 0.25);
  EXPECT_EQ(info["period_unit"], "s");
  EXPECT_EQ(info["cells"], 61U * 51U * 40U);
  EXPECT_EQ(info["safe"], sample::count_cells({}, sample::is_safe));
  EXPECT_EQ(info["invariant"], sample::count_cells({}, sample::is_invariant));
  EXPECT_EQ(info["connection_delay"], 2);
}

TEST_F(ReadInfo, StatesAndInputsAreInTheOrderOfTheSpec) {
  write_sample();
  const Json info = read_info(ResultsReader(path_));
  ASSERT_EQ(info["states"].size(), 3U);
  ASSERT_EQ(info["inputs"].size(), 3U);
  EXPECT_EQ(info["states"][0]["name"], "x1");
  EXPECT_EQ(info["states"][1]["unit"], "s");
  EXPECT_EQ(info["states"][2]["name"], "heading");
  EXPECT_EQ(info["states"][2]["unit"], "");
  EXPECT_EQ(info["states"][2]["points"], 40U);
  EXPECT_EQ(info["states"][2]["last"], 39.0);
  EXPECT_EQ(info["inputs"][1]["name"], "u2");
  EXPECT_EQ(info["inputs"][1]["first"], -1.0);
  EXPECT_EQ(info["inputs"][1]["last"], 3.0);
}

TEST_F(ReadInfo, LayersEndAtTheFixedPoint) {
  write_sample();
  const Json info = read_info(ResultsReader(path_));
  ASSERT_EQ(info["partitions"].size(), 2U);
  EXPECT_EQ(info["partitions"][0]["name"], "alone");
  EXPECT_EQ(info["partitions"][0]["F"], 2);
  EXPECT_EQ(info["partitions"][0]["layers"], (std::vector<std::uint64_t>{62220, 31110, 15555}));
  EXPECT_EQ(info["partitions"][1]["name"], "a|b+c");
  EXPECT_EQ(info["partitions"][1]["F"], 3);
  EXPECT_EQ(info["partitions"][1]["layers"], (std::vector<std::uint64_t>{62220, 31110, 15555, 7777}));
}

TEST_F(ReadInfo, TruncatedPartitionsHaveNoFixedPoint) {
  sample::Options options;
  options.truncated = true;
  write_sample(options);
  const Json info = read_info(ResultsReader(path_));
  EXPECT_EQ(info["partitions"][1]["F"], nullptr);
  EXPECT_EQ(info["partitions"][1]["layers"].size(), 4U);
}

TEST_F(ReadInfo, DatasetsAreListedButNotBareDimensions) {
  write_sample();
  EXPECT_EQ(read_info(ResultsReader(path_))["datasets"],
            (std::vector<std::string>{"/abstraction/heading/first",
                                      "/abstraction/heading/last",
                                      "/abstraction/x1/first",
                                      "/abstraction/x1/last",
                                      "/abstraction/x2/first",
                                      "/abstraction/x2/last",
                                      "/actions/alone/a",
                                      "/actions/alone/b",
                                      "/actions/alone/c",
                                      "/actions/a|b+c/a",
                                      "/actions/a|b+c/b+c",
                                      "/collision_time",
                                      "/controller",
                                      "/delay",
                                      "/fixed_point_index",
                                      "/heading",
                                      "/invariant",
                                      "/layer",
                                      "/layer_size",
                                      "/layers/alone/cell",
                                      "/layers/alone/start",
                                      "/layers/a|b+c/cell",
                                      "/layers/a|b+c/start",
                                      "/partition",
                                      "/safe",
                                      "/spec",
                                      "/spec_json",
                                      "/trigger",
                                      "/u1",
                                      "/u2",
                                      "/u3",
                                      "/x1",
                                      "/x2"}));
}

TEST_F(ReadInfo, AFileThatIsNotThereIsAnInputError) {
  try {
    static_cast<void>(read_info(ResultsReader(path_)));
    FAIL();
  } catch (const IoError& error) {
    EXPECT_EQ(error.what(), "cannot read the results: No such file or directory (" + path_ + ")");
  }
  EXPECT_THROW(static_cast<void>(read_info(ResultsReader(folder_.path()))), IoError);
  EXPECT_THROW(static_cast<void>(read_info(ResultsReader("/dev/null"))), IoError);
}

TEST_F(ReadInfo, OtherFilesAreNotResults) {
  for (const char* text : {"", "x1,x2\n1,2\n"}) {
    write_bytes(path_, text);
    EXPECT_EQ(defect(), "not a coordreq results file: it is not HDF5, or cut short (FILE)");
  }
}

TEST_F(ReadInfo, AFileCutShortIsRefused) {
  write_sample();
  const std::string whole = bytes_of(path_);
  for (const std::size_t size : {std::size_t{8}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write_bytes(path_, whole.substr(0, size));
    EXPECT_EQ(defect(), "not a coordreq results file: it is not HDF5, or cut short (FILE)") << size;
  }
}

TEST_F(ReadInfo, OtherHdf5FilesAreNotResults) {
  Handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "create")
      .close("close");
  EXPECT_EQ(defect(),
            "not a coordreq results file: the attribute filetype is not \"coordreq-results\" (FILE)");
}

TEST_F(ReadInfo, ANewMajorVersionIsRefusedAndANewMinorIsNot) {
  const auto set_version = [this](std::int64_t major, std::int64_t minor) {
    damage([=](const Handle& file) {
      remove_attribute(file, "/", "version");
      hdf5::set_attribute(hdf5::open_object(file, "/"), "version", ElementType::int32, {major, minor});
    });
  };
  write_sample();
  set_version(1, 7);
  EXPECT_EQ(defect(), "");
  set_version(2, 0);
  EXPECT_EQ(defect(), "version 2.0 of the results format, expected version 1 (FILE)");
}

TEST_F(ReadInfo, EveryMissingPartIsNamed) {
  for (const char* path : {"/safe", "/invariant", "/collision_time", "/delay", "/trigger", "/layer_size",
                           "/fixed_point_index", "/partition", "/layer", "/spec"}) {
    write_sample();
    damage([=](const Handle& file) { remove(file, path); });
    EXPECT_NE(defect().find(path), std::string::npos) << path << ": " << defect();
  }
}

TEST_F(ReadInfo, AnAxisWithoutItsGridPointsIsNamed) {
  write_sample();
  damage([](const Handle& file) { remove(file, "/x2"); });
  EXPECT_EQ(defect(), "missing or damaged (FILE:/x2)");
}

TEST_F(ReadInfo, EveryMissingAttributeIsNamed) {
  for (const char* name :
       {"coordreq_version", "git_sha1", "title", "spec_sha256", "period", "period_unit", "guarantee"}) {
    write_sample();
    damage([=](const Handle& file) { remove_attribute(file, "/", name); });
    EXPECT_EQ(defect(), std::string("the attribute ") + name + " is missing (FILE:/)");
  }
  write_sample();
  damage([](const Handle& file) { remove_attribute(file, "/safe", "cells"); });
  EXPECT_EQ(defect(), "the attribute cells is missing (FILE:/safe)");
}

TEST_F(ReadInfo, AWrongShapeIsNamed) {
  write_sample();
  damage([](const Handle& file) {
    remove(file, "/trigger");
    const Handle space = hdf5::create_space({2, 61, 51});
    static_cast<void>(hdf5::create_dataset(file, "/trigger", H5T_STD_I16LE, space));
  });
  EXPECT_EQ(defect(), "wrong shape: found [2, 61, 51], expected [2, 61, 51, 40] (FILE:/trigger)");
}

TEST_F(ReadInfo, AnAttributeOfAnotherTypeIsNamed) {
  write_sample();
  damage([](const Handle& file) {
    remove_attribute(file, "/", "title");
    hdf5::set_attribute(hdf5::open_object(file, "/"), "title", 1.0);
    remove_attribute(file, "/", "period");
    hdf5::set_attribute(hdf5::open_object(file, "/"), "period", std::string("long"));
  });
  EXPECT_EQ(defect(), "the attribute title is not a variable-length string (FILE:/)");
  damage([](const Handle& file) {
    remove_attribute(file, "/", "title");
    hdf5::set_attribute(hdf5::open_object(file, "/"), "title", std::string("sample"));
  });
  EXPECT_EQ(defect(), "the attribute period is not one number (FILE:/)");
}

TEST_F(ReadInfo, AFixedPointBeyondTheLayersIsNamed) {
  write_sample();
  damage([](const Handle& file) {
    const Handle dataset = hdf5::open_object(file, "/fixed_point_index");
    const std::vector<std::int32_t> values = {2, 4};
    H5Dwrite(dataset.get(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
  EXPECT_EQ(defect(), "found 4, expected a layer or -1 (FILE:/fixed_point_index)");
}

}  // namespace
}  // namespace coordreq
