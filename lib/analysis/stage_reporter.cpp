#include "analysis/stage_reporter.hpp"

#include <utility>

#include "results/chunk_layout.hpp"

namespace coordreq {
namespace {

constexpr std::chrono::milliseconds kPause{50};

/// Makes the arrays of a result count the bytes that are filled.
class FillCounter {
 public:
  explicit FillCounter(std::atomic<std::uint64_t>& written) : written_(written) {}

  void watch(ResultArray& array, std::uint64_t elements) {
    watch(array.fill, elements, element_size(array.type));
  }
  void watch(ResultBits& bits, std::uint64_t cells) { watch(bits.fill, cells * ((bits.actions + 7) / 8), 1); }

  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  void watch(FillArray& fill, std::uint64_t elements, std::uint64_t size) {
    total_ += elements * size;
    fill = [own = std::move(fill), size, &written = written_](std::uint64_t begin, std::uint64_t count,
                                                              void* out) {
      own(begin, count, out);
      written.fetch_add(count * size, std::memory_order_relaxed);
    };
  }

  std::atomic<std::uint64_t>& written_;
  std::uint64_t total_ = 0;
};

std::uint64_t cells_of(const ResultContent& content) {
  std::uint64_t cells = 1;
  for (const ResultAxis& axis : content.axes) cells *= axis.is_state ? axis.points.size() : 1;
  return cells;
}

std::uint64_t length_of(const std::string& leading, const ResultContent& content) {
  if (leading == "partition") return content.partitions.size();
  for (const ResultNames& names : content.names) {
    if (names.name == leading) return names.names.size();
  }
  return 1;
}

}  // namespace

StageReporter::StageReporter(std::function<void(const Progress&)> tell, ThreadTeam& team)
    : tell_(std::move(tell)), team_(team) {
  if (!tell_) return;
  team_.set_watch([this](std::int64_t done, std::int64_t count) { on_loop(done, count); });
}

StageReporter::~StageReporter() {
  if (tell_) team_.set_watch({});
}

void StageReporter::enter(const std::string& stage) {
  timer_.begin(stage);
  progress_ = {.stage = stage, .has_temporary = progress_.has_temporary};
  tell_now();
}

void StageReporter::enter_part(const std::string& part) {
  progress_ = {.stage = progress_.stage, .part = part, .has_temporary = progress_.has_temporary};
  tell_now();
}

void StageReporter::step(const WaveStep& step, std::int64_t row_length) {
  progress_.sweep = step.sweep;
  progress_.visited = step.visited;
  progress_.layer = step.layer;
  progress_.cells_left = step.rows_left * row_length;
  progress_.cells = step.rows * row_length;
  progress_.done = progress_.all = 0;
  tell_if_due();
}

void StageReporter::set_temporary(bool has_temporary) {
  const bool is_news = progress_.has_temporary != has_temporary;
  progress_.has_temporary = has_temporary;
  is_news ? tell_now() : tell_if_due();
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
  tell_if_due();
}

void StageReporter::watch_writing(ResultContent& content) {
  FillCounter counter(written_);
  const std::uint64_t cells = cells_of(content);
  for (ResultArray* array : {&content.safe, &content.invariant, &content.collision_time})
    counter.watch(*array, cells);
  for (ResultPartition& partition : content.partitions) {
    counter.watch(partition.delay, cells);
    if (!content.triggers_are_delays) counter.watch(partition.trigger, cells);
    if (partition.layers) counter.watch(partition.layers->cell, partition.layers->start.back());
    for (ResultBits& actions : partition.actions) counter.watch(actions, cells);
  }
  for (std::optional<ResultBits>* bits : {&content.controller, &content.listed}) {
    if (*bits) counter.watch(**bits, cells);
  }
  for (ResultBits& bits : content.convention) counter.watch(bits, cells);
  for (ResultMap& map : content.maps) counter.watch(map.values, cells * length_of(map.leading, content));
  enter_part("");
  to_write_ = counter.total();
}

const std::vector<std::pair<std::string, double>>& StageReporter::finish() {
  timer_.end();
  return timer_.seconds();
}

void StageReporter::tell_now() {
  next_ = Clock::now() + kPause;
  if (tell_) tell_(progress_);
}

void StageReporter::tell_if_due() {
  if (tell_ && Clock::now() >= next_) tell_now();
}

}  // namespace coordreq
