#include "results/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "base/error.hpp"
#include "results/scratch_folder.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using sample::bytes_of;
using sample::ScratchFolder;
using sample::write_bytes;

/// The error of check_writable(), "" if there is none.
std::string refusal(const std::string& path) {
  try {
    check_writable(path);
  } catch (const IoError& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::input_output);
    return error.what();
  }
  return "";
}

void replace(const std::string& path, const std::string& content) {
  OutputFile output(path);
  write_bytes(output.temporary(), content);
  output.commit();
}

TEST(OutputFile, AppearsOnCommitAndNotBefore) {
  const ScratchFolder folder;
  OutputFile output(folder / "a.h5");
  write_bytes(output.temporary(), "new");
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  output.commit();
  EXPECT_EQ(bytes_of(folder / "a.h5"), "new");
  EXPECT_EQ(folder.names(), Names{"a.h5"});
}

TEST(OutputFile, WithoutCommitTheOldFileStaysAndNothingElse) {
  const ScratchFolder folder;
  write_bytes(folder / "a.h5", "old");
  { write_bytes(OutputFile(folder / "a.h5").temporary(), "new"); }
  EXPECT_EQ(bytes_of(folder / "a.h5"), "old");
  EXPECT_EQ(folder.names(), Names{"a.h5"});
}

TEST(OutputFile, ReplacesAndKeepsThePermissions) {
  const ScratchFolder folder;
  write_bytes(folder / "a.h5", "old");
  fs::permissions(folder / "a.h5", fs::perms(0640));
  replace(folder / "a.h5", "new");
  EXPECT_EQ(bytes_of(folder / "a.h5"), "new");
  EXPECT_EQ(fs::status(folder / "a.h5").permissions(), fs::perms(0640));
}

TEST(OutputFile, ALinkStaysAndItsTargetIsReplaced) {
  const ScratchFolder folder;
  fs::create_directory(folder / "far");
  write_bytes(folder / "far/a.h5", "old");
  fs::create_symlink("far/a.h5", folder / "link.h5");
  fs::create_symlink("link.h5", folder / "second.h5");
  replace(folder / "second.h5", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "second.h5"));
  EXPECT_TRUE(fs::is_symlink(folder / "link.h5"));
  EXPECT_EQ(bytes_of(folder / "far/a.h5"), "new");
}

TEST(OutputFile, ADanglingLinkGetsItsTarget) {
  const ScratchFolder folder;
  fs::create_symlink("a.h5", folder / "link.h5");
  replace(folder / "link.h5", "new");
  EXPECT_EQ(bytes_of(folder / "a.h5"), "new");
}

TEST(OutputFile, NamesMayBeAsLongAsTheFileSystemAllows) {
  const ScratchFolder folder;
  const std::string longest(255, 'a');
  replace(folder / longest, "new");
  EXPECT_EQ(folder.names(), Names{longest});
  EXPECT_EQ(refusal(folder / (longest + "a")),
            "cannot write the results: File name too long (" + folder / (longest + "a") + ")");
}

TEST(CheckWritable, LeavesNothingBehind) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal(folder / "a.h5"), "");
  EXPECT_EQ(folder.names(), Names{});
  write_bytes(folder / "a.h5", "old");
  EXPECT_EQ(refusal(folder / "a.h5"), "");
  EXPECT_EQ(bytes_of(folder / "a.h5"), "old");
  EXPECT_EQ(folder.names(), Names{"a.h5"});
}

TEST(CheckWritable, AMissingFolderIsNamed) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal(folder / "out/dir/a.h5"), "the folder does not exist (" + folder / "out/dir" + ")");
}

TEST(CheckWritable, AFolderThatIsAFileIsNamed) {
  const ScratchFolder folder;
  write_bytes(folder / "out", "");
  EXPECT_EQ(refusal(folder / "out/a.h5"), "not a folder (" + folder / "out" + ")");
}

TEST(CheckWritable, AFolderWithoutPlaceForFilesIsNamed) {
  EXPECT_EQ(refusal("/proc/a.h5").substr(0, 34), "cannot create a file in the folder");
}

TEST(CheckWritable, APathThatIsAFolderIsRefused) {
  const ScratchFolder folder;
  fs::create_directory(folder / "out");
  EXPECT_EQ(refusal(folder / "out"), "cannot write the results: this is a folder (" + folder / "out" + ")");
  EXPECT_EQ(refusal(folder / "out/"), "cannot write the results: this is a folder (" + folder / "out/" + ")");
  EXPECT_EQ(refusal(""), "cannot write the results: the path is empty");
}

TEST(CheckWritable, DevicesAndPipesAreRefused) {
  const ScratchFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string reason =
      "cannot write the results: this is a device, a pipe or a socket, not a regular file";
  EXPECT_EQ(refusal("/dev/null"), reason + " (/dev/null)");
  EXPECT_EQ(refusal(pipe), reason + " (" + pipe + ")");
}

TEST(CheckWritable, LinksInACircleAreRefused) {
  const ScratchFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_EQ(refusal(folder / "a"),
            "cannot write the results: too many symbolic links (" + folder / "a" + ")");
}

}  // namespace
}  // namespace coordreq
