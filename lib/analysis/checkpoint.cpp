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
void write_rows(const NumberRows& rows, BlockFileWriter& file) {
  if (rows.rows == 0 || rows.row_length == 0) return;
  const auto row_bytes = static_cast<std::uint64_t>(rows.row_bytes());
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

class Checkpoint::Saving : public Archive {
 public:
  explicit Saving(BlockFileWriter& file) : file_(file) {}
  [[nodiscard]] bool is_loading() const override { return false; }
  void rows(const NumberRows& rows) override {
    Packer head;
    for (const std::int64_t number : {rows.rows, rows.row_bytes()})
      head.add(static_cast<std::uint64_t>(number));
    head.write_to(file_);
    write_rows(rows, file_);
  }

 private:
  [[noreturn]] void refuse(std::string_view what) const override {
    throw std::logic_error(std::string(what));
  }

  BlockFileWriter& file_;
};

class Checkpoint::Loading : public Archive {
 public:
  explicit Loading(const Checkpoint& checkpoint) : checkpoint_(checkpoint), file_(*checkpoint.reader_) {}
  [[nodiscard]] bool is_loading() const override { return true; }
  void rows(const NumberRows& rows) override {
    const std::uint64_t count = read_number(file_);
    const std::uint64_t row_bytes = read_number(file_);
    expect(count == static_cast<std::uint64_t>(rows.rows) &&
               row_bytes == static_cast<std::uint64_t>(rows.row_bytes()),
           "a list has another length");
    for (std::int64_t r = 0; r < rows.rows; ++r) file_.read(row_bytes, rows.row(r));
  }

 private:
  [[noreturn]] void refuse(std::string_view what) const override {
    checkpoint_.refuse(fmt::format("does not fit the spec: {} in the stage '{}'", what, checkpoint_.stage_));
  }

  const Checkpoint& checkpoint_;
  BlockFileReader& file_;
};

StageStore* Checkpoint::enter(const std::string& stage) {
  stage_ = stage;
  return this;
}

StageStore::Kept Checkpoint::take(const Serialise& load) {
  if (!reader_) return Kept::nothing;
  const std::string stage = read_text(*reader_);
  if (stage != stage_) refuse(fmt::format("has the stage '{}', expected '{}'", stage, stage_));
  const bool is_finished = read_number(*reader_) != 0;
  Loading archive(*this);
  load(archive);
  if (reader_->at_end()) reader_.reset();
  return is_finished ? Kept::finished : Kept::unfinished;
}

void Checkpoint::finish(Serialise save) {
  finished_.push_back({stage_, true, std::move(save)});
  if (is_due()) this->save(nullptr);
}

void Checkpoint::step(const Serialise& save) {
  if (!is_due()) return;
  const Record record{.stage = stage_, .save = save};
  this->save(&record);
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
    text.write_to(file);
    Saving archive(file);
    record.save(archive);
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

void check_checkpoint(const CheckpointOptions& options) {
  const OutputFile probe(options.file, kWhat, kSuffix);
  if (options.resume || !std::filesystem::exists(options.file)) return;
  throw UsageError("the checkpoint is there already, expected --resume to go on from it, or another file",
                   options.file);
}

}  // namespace coordreq
