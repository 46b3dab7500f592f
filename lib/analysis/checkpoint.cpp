#include "analysis/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
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
constexpr const char* kFiletype = "coordreq-checkpoint 2";
/// Saving takes at most one part in so many of the time.
constexpr double kShare = 10;

std::string group_name(std::size_t record) {
  return fmt::format("stage{}", record);
}

std::string program() {
  return fmt::format("{} ({})", program_version(), program_git_sha1());
}

std::string sha256_of_controller(const ProblemSpec& spec) {
  return spec.controller.file ? sha256_of_file(controller_path(spec)) : "";
}

}  // namespace

class Checkpoint::Saving : public Archive {
 public:
  explicit Saving(CheckpointWriter& file) : file_(file) {}
  [[nodiscard]] bool is_loading() const override { return false; }
  void rows(const NumberRows& rows) override {
    if (rows.rows > 0 && rows.row_length > 0) file_.add(rows);
  }

 private:
  [[noreturn]] void refuse(std::string_view what) const override {
    throw std::logic_error(std::string(what));
  }

  CheckpointWriter& file_;
};

class Checkpoint::Loading : public Archive {
 public:
  explicit Loading(const Checkpoint& checkpoint) : checkpoint_(checkpoint) {}
  [[nodiscard]] bool is_loading() const override { return true; }
  void rows(const NumberRows& rows) override {
    if (rows.rows > 0 && rows.row_length > 0)
      expect(checkpoint_.reader_->read(rows), "a list has another length or other numbers");
  }

 private:
  [[noreturn]] void refuse(std::string_view what) const override {
    checkpoint_.refuse(fmt::format("does not fit the spec: {} in the stage '{}'", what, checkpoint_.stage_));
  }

  const Checkpoint& checkpoint_;
};

Checkpoint::Checkpoint(CheckpointOptions options, const ProblemSpec& spec, Listener listener)
    : options_(std::move(options)),
      identity_{sha256_hex(spec.text), sha256_of_controller(spec), program()},
      listener_(std::move(listener)),
      saved_(Clock::now()) {
  lock_ = FileLock::take(options_.file, kWhat);
  const bool is_there = lock_.has_value();
  is_there ? open() : make_first();
  remove_unfinished(options_.file, kSuffix);
  if (!options_.resume) return;
  listener_.notice(
      fmt::format("{} ({})", is_there ? "continuing from the checkpoint" : "no checkpoint yet, starting anew",
                  options_.file));
}

/// Two processes that begin at once must not both take it for theirs.
void Checkpoint::make_first() {
  listener_.progress(true);
  try {
    OutputFile output(options_.file, kWhat, kSuffix);
    write(output.temporary(), nullptr);
    std::optional<FileLock> lock = FileLock::take(output.temporary(), kWhat);
    if (output.commit_new()) lock_ = std::move(lock);
  } catch (const IoError& error) {
    listener_.notice(fmt::format("warning: continuing without a new checkpoint: {}", error.what()));
    is_failing_ = true;
  }
  listener_.progress(false);
  if (!lock_ && !is_failing_)
    throw IoError("the checkpoint is in use, expected one run at a time to use it", options_.file);
}

void Checkpoint::open() {
  reader_ = std::make_unique<CheckpointReader>(options_.file);
  if (!reader_->begin("identity") || reader_->read_text() != kFiletype)
    throw ResultsError("this is no checkpoint", options_.file);
  const std::string spec = reader_->read_text();
  const std::string controller = reader_->read_text();
  const std::string version = reader_->read_text();
  const auto differ = [this](const char* what, const std::string& found, const std::string& expected) {
    refuse(fmt::format("was made {}: found {}, expected {}", what, found, expected));
  };
  if (spec != identity_.spec) differ("from another spec", "SHA-256 " + spec, identity_.spec);
  if (controller != identity_.controller)
    differ("with another controller", "SHA-256 " + controller, identity_.controller);
  if (version != identity_.program) differ("by another coordreq", version, identity_.program);
  if (!next_record()) reader_.reset();
}

void Checkpoint::refuse(const std::string& reason) const {
  throw ResultsError("the checkpoint " + reason, options_.file);
}

/// Goes to the next record. @returns false if there is none
bool Checkpoint::next_record() {
  if (!reader_->begin(group_name(taken_))) return false;
  ++taken_;
  next_stage_ = reader_->read_text();
  std::uint8_t is_finished = 0;
  if (!reader_->read(number_rows(&is_finished, 1, 1, 1))) refuse("does not say whether a stage is over");
  next_is_finished_ = is_finished != 0;
  return true;
}

StageStore* Checkpoint::enter(const std::string& stage) {
  stage_ = stage;
  return this;
}

StageStore::Kept Checkpoint::take(const Serialise& load) {
  if (!reader_) return Kept::nothing;
  if (next_stage_ != stage_) refuse(fmt::format("has the stage '{}', expected '{}'", next_stage_, stage_));
  const bool is_finished = next_is_finished_;
  Loading archive(*this);
  load(archive);
  // What was under way is the last that the file has.
  if (!next_record()) reader_.reset();
  if (!is_finished && reader_)
    refuse(fmt::format("continues after the stage '{}', which is not finished", stage_));
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
    replace(under_way);
    is_failing_ = false;
  } catch (const IoError& error) {
    if (!is_failing_)
      listener_.notice(fmt::format("warning: continuing without a new checkpoint: {}", error.what()));
    is_failing_ = true;
  }
  listener_.progress(false);
  saved_ = Clock::now();
  cost_ = saved_ - begin;
}

/// The new file is locked before it has its name.
void Checkpoint::replace(const Record* under_way) {
  OutputFile output(options_.file, kWhat, kSuffix);
  write(output.temporary(), under_way);
  std::optional<FileLock> lock = FileLock::take(output.temporary(), kWhat);
  output.commit();
  lock_ = std::move(lock);
}

void Checkpoint::write(const std::string& temporary, const Record* under_way) {
  CheckpointWriter file(temporary, options_.file, [this] { listener_.progress(true); });
  file.begin("identity");
  for (const std::string& part :
       {std::string(kFiletype), identity_.spec, identity_.controller, identity_.program})
    file.add(part);
  std::size_t count = 0;
  const auto add = [&](const Record& record) {
    file.begin(group_name(count++));
    file.add(record.stage);
    const auto is_finished = static_cast<std::uint8_t>(record.is_finished ? 1 : 0);
    file.add(number_rows(&is_finished, 1, 1, 1));
    Saving archive(file);
    record.save(archive);
  };
  for (const Record& record : finished_) add(record);
  if (under_way != nullptr) add(*under_way);
  file.finish();
}

// A symbolic link stays, as it does when the file is written.
void Checkpoint::remove() {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(options_.file, error);
  if (!error) static_cast<void>(std::filesystem::remove(file, error));
  remove_unfinished(options_.file, kSuffix);
}

void check_checkpoint(const CheckpointOptions& options) {
  const OutputFile probe(options.file, kWhat, kSuffix);
  if (options.resume || !std::filesystem::exists(options.file)) return;
  throw UsageError("the checkpoint is there already, expected --resume to continue from it, or another file",
                   options.file);
}

}  // namespace coordreq
