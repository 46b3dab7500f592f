#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test process.
class ReadSpecFile : public testing::Test {
 protected:
  ReadSpecFile() : folder_(fs::temp_directory_path() / ("coordreq_spec_test." + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~ReadSpecFile() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    const fs::path path = folder_ / name;
    std::ofstream(path) << text;
    return path.string();
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_;
};

std::string io_error(const std::string& path) {
  std::istringstream nothing;
  try {
    static_cast<void>(read_spec_file(path, nothing));
    return {};
  } catch (const IoError& error) {
    return error.what();
  }
}

TEST_F(ReadSpecFile, ReadsTheFile) {
  const std::string text = "// a comment\n" + test::example().dump();
  std::istringstream nothing;
  EXPECT_EQ(read_spec_file(write("a.json", text), nothing).text, text);
}

TEST_F(ReadSpecFile, DashIsStandardInput) {
  std::istringstream input(test::example().dump());
  EXPECT_EQ(read_spec_file("-", input).name, "circle");
  std::istringstream broken("{");
  try {
    static_cast<void>(read_spec_file("-", broken));
    FAIL();
  } catch (const SpecError& error) {
    EXPECT_STREQ(
        error.what(),
        "expected a key in double quotes, found the end of the file (standard input, line 1, column 2)");
  }
}

TEST_F(ReadSpecFile, MissingFileAndFolderAreIoErrors) {
  EXPECT_EQ(io_error(path("none.json")), "no such file (" + path("none.json") + ")");
  EXPECT_EQ(io_error(path("")), "is a folder, expected a spec file (" + path("") + ")");
  EXPECT_EQ(io_error(""), "no such file");
}

TEST_F(ReadSpecFile, UnreadableFileIsAnIoError) {
  const std::string long_name(300, 'a');
  EXPECT_EQ(io_error(long_name), "cannot be read: File name too long (" + long_name + ")");
  // Opens, but its first page cannot be read, whoever asks.
  EXPECT_EQ(io_error("/proc/self/mem"), "cannot be read: Input/output error (/proc/self/mem)");
}

TEST_F(ReadSpecFile, SyntaxErrorNamesTheFile) {
  const std::string file = write("empty.json", "");
  std::istringstream nothing;
  try {
    static_cast<void>(read_spec_file(file, nothing));
    FAIL();
  } catch (const SpecError& error) {
    EXPECT_EQ(error.what(), "the file is empty, expected a spec (" + file + ")");
  }
}

}  // namespace
}  // namespace coordreq
