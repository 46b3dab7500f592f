#include "results/block_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

std::byte expected_at(std::uint64_t place) {
  return static_cast<std::byte>((place * 2654435761U >> 7U) & 255U);
}

/// Writes pieces of these lengths, all from one long pattern.
void write_pieces(const std::string& path, const std::vector<std::uint64_t>& lengths, int threads,
                  const std::function<void()>& progress = {}) {
  ThreadTeam team(threads);
  BlockFileWriter file(path, path, team, progress);
  std::uint64_t before = 0;
  for (const std::uint64_t length : lengths) {
    file.add(length, [before](std::uint64_t begin, std::uint64_t count, std::byte* out) {
      for (std::uint64_t i = 0; i < count; ++i) out[i] = expected_at(before + begin + i);
    });
    before += length;
  }
  file.finish();
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::uint64_t kBlock = BlockFileWriter::kBlockBytes;

TEST(BlockFile, WhatIsWrittenIsReadInAnyPortions) {
  const sample::ScratchFolder folder;
  const std::string path = folder / "file";
  const std::vector<std::uint64_t> lengths = {3, 0, kBlock, kBlock + 1, 9 * kBlock - 5, 1};
  std::uint64_t total = 0;
  for (const std::uint64_t length : lengths) total += length;
  write_pieces(path, lengths, 3);
  for (const std::uint64_t portion : {std::uint64_t{1000}, kBlock, total}) {
    BlockFileReader file(path, "file");
    std::vector<std::byte> bytes(portion);
    for (std::uint64_t place = 0; place < total; place += portion) {
      const std::uint64_t count = std::min(portion, total - place);
      ASSERT_FALSE(file.at_end());
      file.read(count, bytes.data());
      for (std::uint64_t i = 0; i < count; ++i) {
        if (bytes[i] != expected_at(place + i)) FAIL() << "byte " << place + i;
      }
    }
    EXPECT_TRUE(file.at_end());
    EXPECT_THROW(file.read(1, bytes.data()), ResultsError);
  }
}

TEST(BlockFile, BytesDoNotDependOnTheThreads) {
  const sample::ScratchFolder folder;
  write_pieces(folder / "one", {5 * kBlock + 7, 11}, 1);
  write_pieces(folder / "four", {5 * kBlock + 7, 11}, 4);
  EXPECT_TRUE(content(folder / "one") == content(folder / "four"));
}

TEST(BlockFile, EveryDamagedByteIsFound) {
  const sample::ScratchFolder folder;
  const std::string path = folder / "file";
  write_pieces(path, {40, 1, 300}, 1);
  const std::string good = content(path);
  for (std::size_t place = 0; place < good.size(); ++place) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (1 << (place % 8)));
    std::ofstream(path, std::ios::binary) << bad;
    EXPECT_THROW(BlockFileReader(path, "file"), ResultsError) << "byte " << place;
  }
}

TEST(BlockFile, EveryCutAndEveryAdditionIsFound) {
  const sample::ScratchFolder folder;
  const std::string path = folder / "file";
  write_pieces(path, {40, 1, 300}, 1);
  const std::string good = content(path);
  for (std::size_t length = 0; length < good.size(); ++length) {
    std::ofstream(path, std::ios::binary) << good.substr(0, length);
    EXPECT_THROW(BlockFileReader(path, "file"), ResultsError) << length << " bytes";
  }
  std::ofstream(path, std::ios::binary) << good << good;
  EXPECT_THROW(BlockFileReader(path, "file"), ResultsError);
}

TEST(BlockFile, AnExceptionOfTheProgressEndsTheWriting) {
  const sample::ScratchFolder folder;
  const auto stop = [] { throw Error(ExitCode::interrupted, "interrupted", ""); };
  EXPECT_THROW(write_pieces(folder / "file", {kBlock}, 2, stop), Error);
}

TEST(BlockFile, AMissingFileIsAnInputError) {
  EXPECT_THROW(BlockFileReader("no/such/file", "file"), IoError);
}

TEST(BlockFile, AFullDiskIsAnOutputError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  EXPECT_THROW(write_pieces("/dev/full", {30 * kBlock}, 1), IoError);
}

}  // namespace
}  // namespace coordreq
