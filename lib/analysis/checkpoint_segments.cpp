#include "analysis/checkpoint_segments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBeginning = "coordreq-part-";
constexpr const char* kSection = "parts";
constexpr std::int64_t kMostSegments = std::int64_t{1} << 20;
/// Characters of a SHA-256, and the numbers in which they travel.
constexpr std::size_t kDigestBytes = 64;
constexpr std::size_t kDigestNumbers = kDigestBytes / sizeof(std::int64_t);

/// [segments, characters]
NumberRows rows_of_digests(const std::string& digests) {
  constexpr auto kLength = static_cast<std::int64_t>(kDigestBytes);
  return number_rows(reinterpret_cast<const unsigned char*>(digests.data()), kLength,
                     static_cast<std::int64_t>(digests.size()) / kLength, kLength);
}

}  // namespace

std::string CheckpointSegments::manifest(const std::string& folder) {
  return (fs::path(folder) / "coordreq-manifest").string();
}

std::string CheckpointSegments::path(std::int64_t set, std::size_t segment) const {
  return (fs::path(folder_) / fmt::format("{}{}-{}", kBeginning, set, segment)).string();
}

void CheckpointSegments::start(std::function<void()> progress) {
  end_ = 0;
  const std::string file = path(set_.number + 1, static_cast<std::size_t>(ranks_->rank()));
  output_.emplace(file, kCheckpointName, kUnfinished);
  writer_.emplace(output_->temporary(), file, Json{{"part", ranks_->rank()}}, std::move(progress));
}

void CheckpointSegments::begin(const std::string& section) {
  writer_->begin(section, Json::object());
}

void CheckpointSegments::add(const NumberRows& all, ThreadTeam::Range local_rows) {
  end_ = local_rows.end;
  if (local_rows.begin < local_rows.end && all.row_length > 0)
    writer_->add(all.range(local_rows.begin, local_rows.end));
}

void CheckpointSegments::finish() {
  digest_ = writer_->finish();
  writer_.reset();
  output_->commit();
}

bool CheckpointSegments::agree(bool is_well) {
  const auto count = static_cast<std::size_t>(ranks_->count()),
             rank = static_cast<std::size_t>(ranks_->rank());
  next_ = {.number = set_.number + 1, .bounds = {}, .digests = std::vector<std::string>(count)};
  // [process] the end of its rows and the digest; then the number of processes that have failed.
  constexpr std::size_t kOfEach = 1 + kDigestNumbers;
  std::vector<std::int64_t> numbers(kOfEach * count + 1, 0);
  if (is_well) {
    numbers[kOfEach * rank] = end_;
    std::memcpy(&numbers[kOfEach * rank + 1], digest_.data(), kDigestBytes);
  }
  numbers.back() = is_well ? 0 : 1;
  ranks_->add(numbers);
  next_.bounds = {0};
  for (std::size_t segment = 0; segment < count; ++segment) {
    next_.bounds.push_back(numbers[kOfEach * segment]);
    const auto* const digest = reinterpret_cast<const char*>(&numbers[kOfEach * segment + 1]);
    next_.digests[segment].assign(digest, kDigestBytes);
  }
  return numbers.back() == 0;
}

void CheckpointSegments::describe(CheckpointWriter& manifest) const {
  manifest.begin(kSection, {{"set", next_.number}, {"parts", next_.digests.size()}});
  const auto bounds = static_cast<std::int64_t>(next_.bounds.size());
  manifest.add(number_rows(next_.bounds.data(), bounds, 1, bounds));
  std::string digests;
  for (const std::string& digest : next_.digests) digests += digest;
  manifest.add(rows_of_digests(digests));
}

void CheckpointSegments::settle(bool is_kept) {
  writer_.reset();
  output_.reset();
  if (is_kept) set_ = std::move(next_);
  next_ = {};
  if (ranks_->rank() == 0) remove_others();
  static_cast<void>(ranks_->sum(0));  // before anybody begins another one
}

bool CheckpointSegments::take(CheckpointReader& manifest) {
  const Json head = manifest.begin(kSection);
  if (head.is_null()) return true;
  const std::int64_t number = integer_or_zero(head, "set"), count = integer_or_zero(head, "parts");
  if (number < 1 || count < 1 || count > kMostSegments) return false;
  const auto segments = static_cast<std::size_t>(count);
  set_ = {.number = number, .bounds = std::vector<std::int64_t>(segments + 1), .digests = {}};
  std::string digests(segments * kDigestBytes, ' ');
  if (!manifest.read(number_rows(set_.bounds.data(), count + 1, 1, count + 1)) ||
      !manifest.read(rows_of_digests(digests)))
    return false;
  for (std::size_t segment = 0; segment < segments; ++segment)
    set_.digests.push_back(digests.substr(segment * kDigestBytes, kDigestBytes));
  return set_.bounds.front() == 0 && std::ranges::is_sorted(set_.bounds);
}

void CheckpointSegments::check() const {
  for (auto segment = static_cast<std::size_t>(ranks_->rank()); segment < set_.digests.size();
       segment += static_cast<std::size_t>(ranks_->count())) {
    const std::string file = path(set_.number, segment);
    if (!fs::exists(file)) throw ResultsError("a part of the checkpoint is missing", file);
    if (CheckpointReader(file).digest() != set_.digests[segment])
      throw ResultsError("this part of a checkpoint does not belong to its manifest", file);
  }
  static_cast<void>(ranks_->sum(0));  // no process reads before all have looked
}

void CheckpointSegments::read_from(const std::string& section) {
  section_ = section;
  item_ = 0;
}

bool CheckpointSegments::read_segment(std::size_t segment, const NumberRows& all, ThreadTeam::Range run) {
  const auto found = readers_.find(segment);
  CheckpointReader& reader = found != readers_.end()
                                 ? found->second
                                 : readers_.try_emplace(segment, path(set_.number, segment)).first->second;
  if (reader.begin(section_).is_null()) return false;
  const std::int64_t begin = set_.bounds[segment];
  return reader.read_some(item_, all.range(run.begin, run.end), run.begin - begin,
                          set_.bounds[segment + 1] - begin);
}

bool CheckpointSegments::read(const NumberRows& all, std::span<const ThreadTeam::Range> held) {
  if (set_.bounds.back() != all.rows) return false;
  for (std::size_t segment = 0; segment + 1 < set_.bounds.size(); ++segment) {
    for (const ThreadTeam::Range run : held) {
      const ThreadTeam::Range both{std::max(run.begin, set_.bounds[segment]),
                                   std::min(run.end, set_.bounds[segment + 1])};
      if (both.begin < both.end && !read_segment(segment, all, both)) return false;
    }
  }
  ++item_;
  return true;
}

void CheckpointSegments::close() {
  readers_.clear();
}

/// @param is_kept is called with the names of segments, also of unfinished ones
template <class IsKept>
void CheckpointSegments::remove_unless(const IsKept& is_kept) const {
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    if (name.starts_with(kBeginning) && !is_kept(name)) static_cast<void>(fs::remove(it->path(), ignored));
  }
}

void CheckpointSegments::remove_others() const {
  const std::string kept = fmt::format("{}{}-", kBeginning, set_.number);
  remove_unless(
      [&kept](const std::string& name) { return name.starts_with(kept) && !name.ends_with(kUnfinished); });
}

void CheckpointSegments::remove_all() const {
  remove_unless([](const std::string& /*name*/) { return false; });
}

}  // namespace coordreq
