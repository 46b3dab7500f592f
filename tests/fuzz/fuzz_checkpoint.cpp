// Checkpoints: an analysis that shall be taken up from a real checkpoint with changes, and a digest that is
// right. The first byte chooses the checkpoint; a change is three bytes for its place, one for the number of
// bytes, and these.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "analysis/analyze.hpp"
#include "base/thread_team.hpp"
#include "fuzz/target.hpp"
#include "results/sha256.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kDigestBytes = 64;
/// A number of bytes from here on ends the file instead.
constexpr std::uint8_t kCut = 0xf8;

AnalysisOptions with_checkpoint(const std::string& path, bool resume) {
  AnalysisOptions options;
  options.checkpoint = CheckpointOptions{.file = path, .every_seconds = resume ? 1e9 : 0, .resume = resume};
  return options;
}

/// All that a run leaves on its way, without their digests.
std::vector<std::string> checkpoints(const ProblemSpec& spec, ThreadTeam& team) {
  const std::string path = test::InputFile::new_path();
  std::set<std::string> found;
  AnalysisOptions options = with_checkpoint(path, false);
  options.progress = [&](const Progress&) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.size() <= kDigestBytes) return;
    bytes.resize(bytes.size() - kDigestBytes);
    found.insert(std::move(bytes));
  };
  (void)analyze(spec, options, team);
  return {found.begin(), found.end()};
}

std::string changed(std::string bytes, const std::uint8_t* data, std::size_t size) {
  for (std::size_t at = 0; at + 4 <= size;) {
    const std::size_t place =
        (data[at] | std::size_t{data[at + 1]} << 8U | std::size_t{data[at + 2]} << 16U) % bytes.size();
    const std::uint8_t count = data[at + 3];
    at += 4;
    if (count >= kCut) {
      bytes.resize(place + 1);
      continue;
    }
    for (std::size_t k = place; k < std::min(place + count % 9U, bytes.size()) && at < size; ++k, ++at)
      bytes[k] = static_cast<char>(data[at]);
  }
  return bytes + sha256_hex(bytes);
}

}  // namespace
}  // namespace coordreq

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coordreq;
  static const ProblemSpec spec = read_spec(std::string(test::small_spec()), "small");
  static ThreadTeam team(1);
  static const std::vector<std::string> real = checkpoints(spec, team);
  if (size == 0) return 0;
  const std::string text = changed(real[data[0] % real.size()], data + 1, size - 1);
  const test::InputFile file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  test::answers([&] { (void)analyze(spec, with_checkpoint(file.path(), true), team); });
  return 0;
}
