#include "analysis/stage_reporter.hpp"

#include <map>
#include <utility>

#include "answers/field_table.hpp"

namespace coordreq {
namespace {

constexpr std::chrono::milliseconds kPause{50};

/// `fill`, with the bytes that it fills counted.
FillArray counting(FillArray fill, std::uint64_t size, std::atomic<std::uint64_t>& written) {
  return
      [fill_elements = std::move(fill), size, &written](std::uint64_t begin, std::uint64_t count, void* out) {
        fill_elements(begin, count, out);
        written.fetch_add(count * size, std::memory_order_relaxed);
      };
}

}  // namespace

StageReporter::StageReporter(std::function<void(const Progress&)> report, ThreadTeam& team)
    : report_(std::move(report)), team_(team) {
  if (!report_) return;
  team_.set_watch([this](std::int64_t done, std::int64_t count) { on_loop(done, count); });
}

StageReporter::~StageReporter() {
  if (report_) team_.set_watch({});
}

void StageReporter::enter(const std::string& stage) {
  timer_.begin(stage);
  progress_ = {.stage = stage, .has_temporary = progress_.has_temporary};
  report_now();
}

void StageReporter::enter_substage(const std::string& substage) {
  progress_ = {.stage = progress_.stage, .substage = substage, .has_temporary = progress_.has_temporary};
  report_now();
}

void StageReporter::step(const WaveStep& step, std::int64_t row_length) {
  progress_.sweep = step.sweep;
  progress_.visited = step.visited;
  progress_.layer = step.layer;
  progress_.cells_left = step.rows_left * row_length;
  progress_.cells = step.rows * row_length;
  progress_.done = progress_.all = 0;
  report_if_due();
}

void StageReporter::set_temporary(bool has_temporary) {
  const bool is_news = progress_.has_temporary != has_temporary;
  progress_.has_temporary = has_temporary;
  is_news ? report_now() : report_if_due();
}

/// Loops within a sweep say nothing that its steps do not, but time passes in them.
void StageReporter::on_loop(std::int64_t done, std::int64_t count) {
  if (to_write_ > 0) {
    progress_.done = static_cast<std::int64_t>(written_.load(std::memory_order_relaxed));
    progress_.all = static_cast<std::int64_t>(to_write_);
  } else if (progress_.sweep == 0 && !progress_.has_temporary) {
    progress_.done = done;
    progress_.all = count;
  }
  report_if_due();
}

void StageReporter::watch_writing(const ProblemSpec& spec, FieldValues& values) {
  std::map<std::string, std::uint64_t> lengths = values.lengths;
  std::uint64_t bytes = 0;
  for (const Field& field : result_fields(spec)) {
    if (field.scale && field.scale->least == field.scale->most) lengths[field.path] = field.scale->least;
    const auto entry = values.entries.find(field.path);
    const auto shape = shape_of(field, lengths);
    if (field.scale || !shape || entry == values.entries.end() || !entry->second.equals.empty()) continue;
    std::uint64_t size = element_size(entry->second.array.type);
    entry->second.array.fill = counting(std::move(entry->second.array.fill), size, written_);
    for (const std::uint64_t length : *shape) size *= length;
    bytes += size;
  }
  enter_substage("");
  to_write_ = bytes;
}

const std::vector<std::pair<std::string, double>>& StageReporter::finish() {
  timer_.end();
  return timer_.seconds();
}

void StageReporter::report_now() {
  next_ = Clock::now() + kPause;
  if (report_) report_(progress_);
}

void StageReporter::report_if_due() {
  if (report_ && Clock::now() >= next_) report_now();
}

}  // namespace coordreq
