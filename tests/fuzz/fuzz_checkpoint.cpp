// Checkpoints: an analysis that shall be taken up from a real checkpoint with changes, and checksums that are
// right. The first byte chooses the checkpoint; a change is three bytes for its place, one for the number of
// bytes, and these. Places are those of lines and of numbers as they are before they are packed.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/analyze.hpp"
#include "base/thread_team.hpp"
#include "fuzz/target.hpp"
#include "results/chunk_codec.hpp"
#include "results/sha256.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18U;
constexpr std::string_view kEnd = "end\n";
/// A number of bytes from here on ends the file instead.
constexpr std::uint8_t kCut = 0xf8;

/// A line, or the numbers of a block.
struct Piece {
  std::string bytes;
  std::size_t number_bytes = 0;  ///< 0: a line
  bool ends_list = false;
};
using Pieces = std::vector<Piece>;

/// Takes a real checkpoint to pieces, without its checksums and its end.
class Taker {
 public:
  explicit Taker(const std::string& bytes) : bytes_(bytes) {}

  Pieces pieces() {
    Pieces pieces{{line()}, {line()}};
    for (std::string head = line(); head != kEnd; head = line()) {
      const nlohmann::json json = nlohmann::json::parse(head);
      pieces.push_back({std::move(head)});
      if (json.contains("type")) add_blocks(json, pieces);
    }
    return pieces;
  }

 private:
  std::string line() { return take(bytes_.find('\n', at_) + 1 - at_); }
  std::string take(std::size_t count) {
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  void add_blocks(const nlohmann::json& head, Pieces& pieces) {
    const auto number_bytes = static_cast<std::size_t>(head["type"].get<std::string>()[1] - '0');
    std::size_t left = head["rows"].get<std::size_t>() * head["length"].get<std::size_t>() * number_bytes;
    for (std::size_t size = 0; left > 0; left -= size) {
      size = std::min(left, kBlockBytes);
      std::uint32_t length = 0;
      std::memcpy(&length, take(sizeof(length)).data(), sizeof(length));
      const std::string packed = take(length);
      std::vector<std::byte> raw;
      if (!unpack_chunk(std::as_bytes(std::span(packed)), size, true, number_bytes, raw)) std::abort();
      pieces.push_back({{reinterpret_cast<const char*>(raw.data()), raw.size()}, number_bytes});
    }
    pieces.back().ends_list = true;
    (void)line();  // its checksum
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// Puts them together again, with checksums.
std::string file_of(const Pieces& pieces) {
  std::string file;
  ChunkCodec codec;
  for (const Piece& piece : pieces) {
    if (piece.number_bytes == 0 || piece.bytes.size() % piece.number_bytes != 0) {
      file += piece.bytes;
    } else {
      std::vector<std::byte> packed;
      codec.pack(std::as_bytes(std::span(piece.bytes)), piece.number_bytes, packed);
      const auto length = static_cast<std::uint32_t>(packed.size());
      file.append(reinterpret_cast<const char*>(&length), sizeof(length));
      file.append(reinterpret_cast<const char*>(packed.data()), packed.size());
    }
    if (piece.ends_list) file += sha256_hex(file) + "\n";
  }
  file += kEnd;
  return file + sha256_hex(file) + "\n";
}

AnalysisOptions with_checkpoint(const std::string& path, bool resume) {
  AnalysisOptions options;
  options.checkpoint = CheckpointOptions{.file = path, .every_seconds = resume ? 1e9 : 0, .resume = resume};
  return options;
}

std::size_t size_of(const Pieces& pieces) {
  std::size_t size = 0;
  for (const Piece& piece : pieces) size += piece.bytes.size();
  return size;
}

/// All that a run leaves on its way, the one that has most first.
std::vector<Pieces> checkpoints(const ProblemSpec& spec, ThreadTeam& team) {
  const std::string path = test::InputFile::new_path();
  std::set<std::string> found;
  AnalysisOptions options = with_checkpoint(path, false);
  options.progress = [&](const Progress&) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!bytes.empty()) found.insert(std::move(bytes));
  };
  (void)analyze(spec, options, team);
  std::vector<Pieces> all;
  for (const std::string& bytes : found) {
    all.push_back(Taker(bytes).pieces());
    if (file_of(all.back()) != bytes) std::abort();
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Pieces& a, const Pieces& b) { return size_of(a) > size_of(b); });
  return all;
}

/// The byte at a place, counted through all pieces. REQUIRES: it is there.
char* byte_at(Pieces& pieces, std::size_t place) {
  std::size_t i = 0;
  for (; place >= pieces[i].bytes.size(); ++i) place -= pieces[i].bytes.size();
  return &pieces[i].bytes[place];
}

void cut_behind(Pieces& pieces, std::size_t place) {
  std::size_t i = 0;
  for (; place >= pieces[i].bytes.size(); ++i) place -= pieces[i].bytes.size();
  pieces[i].bytes.resize(place + 1);
  pieces.resize(i + 1);
}

std::string changed(Pieces pieces, const std::uint8_t* data, std::size_t size) {
  for (std::size_t at = 0; at + 4 <= size;) {
    const std::size_t all = size_of(pieces);
    const std::size_t place =
        (data[at] | std::size_t{data[at + 1]} << 8U | std::size_t{data[at + 2]} << 16U) % all;
    const std::uint8_t count = data[at + 3];
    at += 4;
    if (count >= kCut) {
      cut_behind(pieces, place);
      continue;
    }
    for (std::size_t k = place; k < std::min(place + count % 9U, all) && at < size; ++k, ++at)
      *byte_at(pieces, k) = static_cast<char>(data[at]);
  }
  return file_of(pieces);
}

}  // namespace
}  // namespace coordreq

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  static const ProblemSpec spec = read_spec(std::string(test::small_spec()), "small");
  static ThreadTeam team(1);
  static const std::vector<Pieces> real = checkpoints(spec, team);
  if (size == 0) return 0;
  const std::string text = changed(real[data[0] % real.size()], data + 1, size - 1);
  const test::InputFile file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  test::answers([&] { (void)analyze(spec, with_checkpoint(file.path(), true), team); });
  return 0;
}
