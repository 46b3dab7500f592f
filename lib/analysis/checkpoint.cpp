#include "analysis/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "results/controller_file.hpp"
#include "results/output_file.hpp"
#include "results/sha256.hpp"
#include "results/version.hpp"

namespace coordreq {
namespace {

constexpr const char* kWhat = "the checkpoint";
constexpr const char* kSuffix = ".new";
constexpr const char* kFiletype = "coordreq-checkpoint 1";
/// Saving takes at most one part in so many of the time.
constexpr double kShare = 10;
/// No name of a stage is longer.
constexpr std::uint64_t kLongestText = 1 << 20;

/// Numbers and texts one after the other.
class Packer {
 public:
  void add(std::uint64_t number) {
    for (int i = 0; i < 8; ++i) bytes_ += static_cast<char>(number >> (8 * i) & 255U);
  }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  void write_to(BlockFileWriter& file) const {
    file.add(bytes_.size(), [this](std::uint64_t begin, std::uint64_t count, std::byte* out) {
      std::memcpy(out, bytes_.data() + begin, count);
    });
  }

 private:
  std::string bytes_;
};

std::uint64_t read_number(BlockFileReader& file) {
  std::byte bytes[8];
  file.read(8, bytes);
  std::uint64_t number = 0;
  for (int i = 0; i < 8; ++i) number |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return number;
}

std::string read_text(BlockFileReader& file) {
  std::string text(std::min(read_number(file), kLongestText), '\0');
  void* first = text.data();
  file.read(text.size(), static_cast<std::byte*>(first));
  return text;
}

/// Rows next to one another.
void write_rows(const RowBytes& rows, BlockFileWriter& file) {
  if (rows.rows == 0 || rows.row_bytes == 0) return;
  const auto row_bytes = static_cast<std::uint64_t>(rows.row_bytes);
  file.add(static_cast<std::uint64_t>(rows.rows) * row_bytes,
           [&rows, row_bytes](std::uint64_t begin, std::uint64_t count, std::byte* out) {
             while (count > 0) {
               const std::uint64_t offset = begin % row_bytes;
               const std::uint64_t here = std::min(count, row_bytes - offset);
               std::memcpy(out, rows.row(static_cast<std::int64_t>(begin / row_bytes)) + offset, here);
               begin += here;
               count -= here;
               out += here;
             }
           });
}

std::string program() {
  return fmt::format("{} ({})", program_version(), program_git_sha1());
}

std::string sha256_of_controller(const ProblemSpec& spec) {
  return spec.controller.file ? sha256_of_file(controller_path(spec)) : "";
}

}  // namespace

Checkpoint::Checkpoint(CheckpointOptions options, const ProblemSpec& spec, ThreadTeam& team,
                       Listener listener)
    : options_(std::move(options)), team_(team), listener_(std::move(listener)), saved_(Clock::now()) {
  identity_ = {sha256_hex(spec.text), sha256_of_controller(spec), program()};
  const bool is_there = std::filesystem::exists(options_.file);
  if (is_there) open();
  if (!options_.resume) return;
  listener_.notice(fmt::format("{} ({})",
                               is_there ? "going on from the checkpoint" : "no checkpoint yet, starting anew",
                               options_.file));
}

void Checkpoint::open() {
  reader_ = std::make_unique<BlockFileReader>(options_.file, "checkpoint");
  if (reader_->at_end() || read_text(*reader_) != kFiletype)
    throw ResultsError("this is no checkpoint", options_.file);
  const std::string spec = read_text(*reader_);
  const std::string controller = read_text(*reader_);
  const std::string version = read_text(*reader_);
  const auto differ = [this](const char* what, const std::string& found, const std::string& expected) {
    refuse(fmt::format("was made {}: found {}, expected {}", what, found, expected));
  };
  if (spec != identity_.spec) differ("from another spec", "SHA-256 " + spec, identity_.spec);
  if (controller != identity_.controller)
    differ("with another controller", "SHA-256 " + controller, identity_.controller);
  if (version != identity_.program) differ("by another coordreq", version, identity_.program);
  if (reader_->at_end()) reader_.reset();
}

void Checkpoint::refuse(const std::string& reason) const {
  throw ResultsError("the checkpoint " + reason, options_.file);
}

std::optional<Checkpoint::Record> Checkpoint::next_record(const std::string& stage) {
  if (!reader_) return std::nullopt;
  Record record{.stage = read_text(*reader_), .is_finished = read_number(*reader_) != 0};
  if (record.stage != stage) refuse(fmt::format("has the stage '{}', expected '{}'", record.stage, stage));
  const std::uint64_t numbers = read_number(*reader_);
  for (std::uint64_t i = 0; i < numbers; ++i) record.numbers.push_back(read_number(*reader_));
  const std::uint64_t parts = read_number(*reader_);
  for (std::uint64_t i = 0; i < parts; ++i) {
    RowBytes& rows = record.rows.emplace_back();
    rows.rows = static_cast<std::int64_t>(read_number(*reader_));
    rows.row_bytes = static_cast<std::int64_t>(read_number(*reader_));
    rows.element_bytes = static_cast<std::int64_t>(read_number(*reader_));
  }
  return record;
}

void Checkpoint::read_rows(const RowBytes& stored, std::int64_t rows, std::int64_t row_bytes,
                           const std::function<std::byte*(std::int64_t)>& row_at) {
  if (stored.rows != rows || stored.row_bytes != row_bytes) {
    refuse(fmt::format("has {} rows of {} bytes, expected {} of {}", stored.rows, stored.row_bytes, rows,
                       row_bytes));
  }
  for (std::int64_t r = 0; r < rows; ++r) reader_->read(static_cast<std::uint64_t>(row_bytes), row_at(r));
}

/// What was under way is the last that the file has.
void Checkpoint::end_record() {
  if (reader_->at_end()) reader_.reset();
}

bool Checkpoint::take_lists(
    const std::string& stage,
    const std::function<void(const std::vector<std::uint64_t>&, const ReadList&)>& load) {
  const std::optional<Record> record = next_record(stage);
  if (!record) return false;
  load(record->numbers, [this](std::byte* out, std::uint64_t bytes) { reader_->read(bytes, out); });
  end_record();
  return true;
}

template <class Level>
LevelMap Checkpoint::read_levels(const RowBytes& stored, const RowEngine& engine) {
  LevelRows<Level> levels = engine.make_levels<Level>(engine.posts());
  const auto row_bytes =
      static_cast<std::int64_t>(levels.row_length() * static_cast<std::int64_t>(sizeof(Level)));
  read_rows(stored, levels.rows(), row_bytes, [&levels](std::int64_t r) {
    void* row = levels.row(r);
    return static_cast<std::byte*>(row);
  });
  for (std::int64_t r = 0; r < levels.rows(); ++r) levels.close(r);
  return LevelMap(std::move(levels));
}

std::optional<SavedState<LevelMap>> Checkpoint::take_levels(const std::string& stage,
                                                            const RowEngine& engine) {
  const std::optional<Record> record = next_record(stage);
  if (!record) return std::nullopt;
  if (record->rows.size() != 1) refuse("has no levels for " + stage);
  const RowBytes& stored = record->rows.front();
  SavedState<LevelMap> saved{.is_finished = record->is_finished};
  saved.state = stored.element_bytes == 1   ? read_levels<std::uint8_t>(stored, engine)
                : stored.element_bytes == 2 ? read_levels<std::uint16_t>(stored, engine)
                                            : read_levels<std::uint32_t>(stored, engine);
  end_record();
  return saved;
}

std::optional<SavedState<std::vector<CellSet>>> Checkpoint::take_sets(const std::string& stage,
                                                                      const CellSet& like) {
  const std::optional<Record> record = next_record(stage);
  if (!record) return std::nullopt;
  SavedState<std::vector<CellSet>> saved{.is_finished = record->is_finished};
  for (const RowBytes& stored : record->rows) {
    CellSet& set = saved.state.emplace_back(like.rows(), like.row_length());
    read_rows(stored, set.rows(), bytes_of(set).row_bytes, [&set](std::int64_t r) {
      void* row = set.row(r).data();
      return static_cast<std::byte*>(row);
    });
  }
  end_record();
  return saved;
}

void Checkpoint::finish(const std::string& stage, SavedLists lists) {
  add_finished({stage, true, std::move(lists.numbers), std::move(lists.lists)});
}

void Checkpoint::finish(const std::string& stage, const LevelMap& levels) {
  const RowBytes rows = levels.visit([](const auto& own) { return bytes_of(own); });
  add_finished({.stage = stage, .is_finished = true, .rows = {rows}});
}

void Checkpoint::finish(const std::string& stage, const std::vector<CellSet>& sets) {
  Record record{.stage = stage, .is_finished = true};
  for (const CellSet& set : sets) record.rows.push_back(bytes_of(set));
  add_finished(std::move(record));
}

void Checkpoint::add_finished(Record record) {
  finished_.push_back(std::move(record));
  if (is_due()) save(nullptr);
}

void Checkpoint::step(const std::string& stage, std::span<const RowBytes> state) {
  if (state.empty() || !is_due()) return;
  const Record record{.stage = stage, .rows = {state.begin(), state.end()}};
  save(&record);
}

/// As long as there is more to take up, a new file would hold less than the old one.
bool Checkpoint::is_due() const {
  if (reader_) return false;
  if (options_.every_seconds <= 0) return true;
  const double pause = std::max(options_.every_seconds, (kShare - 1) * cost_.count());
  return Clock::now() - saved_ >= std::chrono::duration<double>(pause);
}

void Checkpoint::save(const Record* under_way) {
  const Clock::time_point begin = Clock::now();
  listener_.progress(true);
  try {
    write(under_way);
    is_failing_ = false;
  } catch (const IoError& error) {
    if (!is_failing_)
      listener_.notice(fmt::format("warning: going on without a new checkpoint: {}", error.what()));
    is_failing_ = true;
  }
  listener_.progress(false);
  saved_ = Clock::now();
  cost_ = saved_ - begin;
}

void Checkpoint::write(const Record* under_way) {
  OutputFile output(options_.file, kWhat, kSuffix);
  BlockFileWriter file(output.temporary(), options_.file, team_, [this] { listener_.progress(true); });
  Packer head;
  head.add(kFiletype);
  for (const std::string& part : {identity_.spec, identity_.controller, identity_.program}) head.add(part);
  head.write_to(file);
  const auto add = [&file](const Record& record) {
    Packer text;
    text.add(record.stage);
    text.add(record.is_finished ? 1 : 0);
    text.add(record.numbers.size());
    for (const std::uint64_t number : record.numbers) text.add(number);
    text.add(record.rows.size());
    for (const RowBytes& rows : record.rows) {
      for (const std::int64_t number : {rows.rows, rows.row_bytes, rows.element_bytes})
        text.add(static_cast<std::uint64_t>(number));
    }
    text.write_to(file);
    for (const RowBytes& rows : record.rows) write_rows(rows, file);
  };
  for (const Record& record : finished_) add(record);
  if (under_way != nullptr) add(*under_way);
  file.finish();
  output.commit();
}

// A symbolic link stays, as it does when the file is written.
void Checkpoint::remove() {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(options_.file, error);
  if (!error) static_cast<void>(std::filesystem::remove(file, error));
}

std::vector<std::string> files_of(const CheckpointOptions& options) {
  std::error_code ignored;  // what leads nowhere is written where it says
  const std::filesystem::path end = std::filesystem::canonical(options.file, ignored);
  return {options.file, (end.empty() ? options.file : end.string()) + kSuffix};
}

void check_checkpoint(const CheckpointOptions& options) {
  const std::string unfinished = files_of(options).back();
  if (!may_be_block_file(unfinished))
    throw UsageError("expected a checkpoint that a kill has left behind, or nothing, found another file",
                     unfinished);
  const OutputFile probe(options.file, kWhat, kSuffix);
  if (options.resume || !std::filesystem::exists(options.file)) return;
  throw UsageError("the checkpoint is there already, expected --resume to go on from it, or another file",
                   options.file);
}

}  // namespace coordreq
