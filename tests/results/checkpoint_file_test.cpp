#include "results/checkpoint_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/error.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

using Elements = std::vector<std::int32_t>;

NumberRows rows_of(const Elements& numbers, std::int64_t length) {
  return number_rows(numbers.data(), length, static_cast<std::int64_t>(numbers.size()) / length, length);
}

class CheckpointFile : public testing::Test {
 protected:
  std::string path() const { return folder_ / "saved"; }

  /// Two sections, the second one with lists of two types.
  void write_small() {
    CheckpointWriter writer(path(), path(), {{"spec", "s"}}, {});
    writer.begin("first", {{"finished", true}});
    const Elements numbers = {1, -2, 3, -4, 5, -6};
    writer.add(rows_of(numbers, 2));
    writer.begin("second", Json::object());
    const std::vector<double> more = {0.5};
    writer.add(number_rows(more.data(), 1, 1, 1));
    writer.add(rows_of(numbers, 6));
    digest_ = writer.finish();
  }

  void expect_refused(const std::string& what) const {
    try {
      const CheckpointReader reader(path());
      ADD_FAILURE() << "not refused: " << what;
    } catch (const ResultsError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what;
    }
  }

  sample::ScratchFolder folder_;
  std::string digest_;
};

TEST_F(CheckpointFile, WhatIsWrittenIsRead) {
  write_small();
  CheckpointReader reader(path());
  EXPECT_EQ(reader.digest(), digest_);
  EXPECT_EQ(reader.header()["spec"], "s");
  Elements found(6);
  double more = 0;
  EXPECT_FALSE(reader.begin("second").is_null());
  EXPECT_TRUE(reader.read(number_rows(&more, 1, 1, 1)));
  EXPECT_TRUE(reader.read(rows_of(found, 6)));
  EXPECT_FALSE(reader.read(rows_of(found, 6)));  // there is no more
  EXPECT_EQ(more, 0.5);
  EXPECT_EQ(found, (Elements{1, -2, 3, -4, 5, -6}));
  EXPECT_EQ(reader.begin("first")["finished"], true);
  EXPECT_TRUE(reader.begin("third").is_null());
  EXPECT_FALSE(reader.read(rows_of(found, 6)));
}

TEST_F(CheckpointFile, AListOfAnotherShapeOrTypeIsNotTaken) {
  write_small();
  CheckpointReader reader(path());
  Elements found(6);
  std::vector<std::uint32_t> other(6);
  std::vector<float> real(6);
  for (const NumberRows& rows : {rows_of(found, 3), rows_of(found, 1), number_rows(other.data(), 2, 3, 2),
                                 number_rows(real.data(), 2, 3, 2)}) {
    static_cast<void>(reader.begin("first"));
    EXPECT_FALSE(reader.read(rows));
  }
}

TEST_F(CheckpointFile, RowsStandWhereTheyAreSaidTo) {
  const std::vector<std::uint16_t> held = {1, 2, 0, 3, 4, 0};  // two rows, and what lies between them
  const std::vector<std::uint32_t> slots = {1, 0, 1};
  NumberRows rows = number_rows(held.data(), 3, 3, 2);
  rows.slots = slots.data();
  CheckpointWriter writer(path(), path(), Json::object(), {});
  writer.begin("one", Json::object());
  writer.add(rows);
  writer.finish();
  CheckpointReader reader(path());
  static_cast<void>(reader.begin("one"));
  std::vector<std::uint16_t> found(9);
  ASSERT_TRUE(reader.read(number_rows(found.data(), 3, 3, 2)));
  EXPECT_EQ(found, (std::vector<std::uint16_t>{3, 4, 0, 1, 2, 0, 3, 4, 0}));
}

/// Of so many rows that the list is cut into blocks, inside of rows too.
TEST_F(CheckpointFile, SomeRowsOfAListAreThoseOfTheWhole) {
  constexpr std::int64_t kRows = 1000, kLength = 777;
  Elements numbers(kRows * kLength);
  std::iota(numbers.begin(), numbers.end(), 5);
  CheckpointWriter writer(path(), path(), Json::object(), {});
  writer.begin("one", Json::object());
  writer.add(rows_of(numbers, kLength));
  writer.finish();
  CheckpointReader reader(path());
  static_cast<void>(reader.begin("one"));
  const std::pair<std::int64_t, std::int64_t> parts[] = {{0, 1000}, {0, 1}, {84, 2}, {500, 337}, {999, 1}};
  for (const auto& [first, count] : parts) {
    Elements found(static_cast<std::size_t>(count * kLength));
    ASSERT_TRUE(reader.read_some(0, rows_of(found, kLength), first, kRows));
    EXPECT_TRUE(std::equal(found.begin(), found.end(), numbers.begin() + first * kLength)) << first;
  }
}

TEST_F(CheckpointFile, EveryByteThatChangesOrIsMissingShows) {
  write_small();
  const std::string good = sample::bytes_of(path());
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int mask : {1, 0x80}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ mask);
      sample::write_bytes(path(), bad);
      expect_refused("byte " + std::to_string(i));
    }
    sample::write_bytes(path(), good.substr(0, i));
    expect_refused(std::to_string(i) + " bytes");
  }
  sample::write_bytes(path(), good + "x");
  expect_refused("a byte more");
}

/// Lists of 4 GiB are nothing special: only what is asked for is unpacked.
TEST_F(CheckpointFile, RowsOfAListOf5GiBAreRead) {
  constexpr std::int64_t kRows = 5 << 12, kLength = 1 << 18;  // a row is a block
  std::vector<std::byte> zeros(kLength), last(kLength, std::byte{7});
  std::vector<std::byte> packed;
  Sha256 digest;
  std::ofstream file(path(), std::ios::binary);
  const auto put = [&](std::string_view bytes) {
    file << bytes;
    digest.add(bytes);
  };
  const auto put_block = [&](const std::vector<std::byte>& raw) {
    ChunkCodec().pack(raw, 1, packed);
    const auto length = static_cast<std::uint32_t>(packed.size());
    std::string block(sizeof(length), ' ');
    std::memcpy(block.data(), &length, sizeof(length));
    return block.append(reinterpret_cast<const char*>(packed.data()), packed.size());
  };
  put("coordreq-checkpoint 3\n{}\n{\"section\":\"one\"}\n");
  put(Json{{"type", "u1"}, {"rows", kRows}, {"length", kLength}}.dump() + "\n");
  const std::string block = put_block(zeros);
  for (std::int64_t row = 0; row + 1 < kRows; ++row) put(block);
  put(put_block(last));
  put(digest.hex() + "\nend\n");
  put(digest.hex() + "\n");
  file.close();
  CheckpointReader reader(path());
  static_cast<void>(reader.begin("one"));
  std::vector<std::uint8_t> found(2 * kLength, 1);
  ASSERT_TRUE(reader.read_some(0, number_rows(found.data(), kLength, 2, kLength), kRows - 2, kRows));
  EXPECT_EQ(std::count(found.begin(), found.end(), 0), kLength);
  EXPECT_EQ(std::count(found.begin(), found.end(), 7), kLength);
}

/// What the head of a list says is believed only as far as its blocks go.
TEST_F(CheckpointFile, AHeadThatSaysMoreThanThereIsIsRefused) {
  for (const char* head :
       {R"({"type":"u1","rows":1,"length":4611686018427387904})",
        R"({"type":"u8","rows":2,"length":9223372036854775807})",
        R"({"type":"u1","rows":18446744073709551615,"length":1})", R"({"type":"u1","rows":-1,"length":1})",
        R"({"type":"u0","rows":1,"length":1})", R"({"type":"u1","rows":1.5,"length":1})",
        R"({"type":7,"rows":1})", R"([1,2])", "{", "", "null"}) {
    const std::string text = std::string("coordreq-checkpoint 3\n{}\n{\"section\":\"one\"}\n") + head + "\n";
    sample::write_bytes(path(), text + "end\n" + sha256_hex(text + "end\n") + "\n");
    expect_refused(head);
  }
}

TEST_F(CheckpointFile, AnotherFileIsSaidToBeNone) {
  const auto message = [this](const std::string& bytes) -> std::string {
    sample::write_bytes(path(), bytes);
    try {
      const CheckpointReader reader(path());
    } catch (const ResultsError& error) {
      return error.what();
    }
    return "";
  };
  const std::string none = "this is no checkpoint, or a part of one (" + path() + ")";
  EXPECT_EQ(message(""), none);
  EXPECT_EQ(message("hello"), none);
  EXPECT_EQ(message("coordreq-checkpoint 4\n"), none);
  EXPECT_EQ(message("\x89HDF\r\n\x1a\n and so on, and so on, and so on"),
            "this is HDF5: a checkpoint of an earlier version of coordreq, or none (" + path() + ")");
}

TEST_F(CheckpointFile, WhatIsNoFileIsNotWaitedFor) {
  EXPECT_THROW(CheckpointReader{path()}, IoError);
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_THROW(CheckpointReader{path()}, IoError);
  EXPECT_THROW(CheckpointReader{folder_.path()}, IoError);
}

TEST_F(CheckpointFile, AFullDiskIsTold) {
  try {
    CheckpointWriter writer("/dev/full", "saved", Json::object(), {});
    writer.begin("one", Json::object());
    const Elements numbers(1 << 20);
    writer.add(rows_of(numbers, 1));
    writer.finish();
    ADD_FAILURE() << "nothing told";
  } catch (const IoError& error) {
    EXPECT_STREQ(error.what(), "cannot write: No space left on device (saved)");
  }
}

}  // namespace
}  // namespace coordreq
