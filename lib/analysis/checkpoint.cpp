#include "analysis/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "results/controller_file.hpp"
#include "results/output_file.hpp"
#include "results/sha256.hpp"
#include "results/version.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Saving takes at most this fraction of the time: one over this number.
constexpr double kShare = 10;

std::string section_name(std::size_t record) {
  return fmt::format("stage{}", record);
}

/// The text under a key of an object; empty if it cannot be printed on one line.
std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  const std::string text = found != object.end() && found->is_string() ? found->get<std::string>() : "";
  const bool is_printable = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; });
  return is_printable ? text : "";
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
  /// @param file null: only segments are written here @param segments null: there are none
  Saving(CheckpointWriter* file, CheckpointSegments* segments) : file_(file), segments_(segments) {}
  [[nodiscard]] bool is_loading() const override { return false; }
  void rows(const NumberRows& rows) override {
    if (file_ != nullptr && rows.rows > 0 && rows.row_length > 0) file_->add(rows);
  }
  void grid_rows(const NumberRows& all, ThreadTeam::Range local_rows,
                 std::span<const ThreadTeam::Range> /*held*/) override {
    segments_ == nullptr ? rows(all) : segments_->add(all, local_rows);
  }

 private:
  [[noreturn]] void refuse(std::string_view what) const override {
    throw std::logic_error(std::string(what));
  }

  CheckpointWriter* file_;
  CheckpointSegments* segments_;
};

class Checkpoint::Loading : public Archive {
 public:
  explicit Loading(Checkpoint& checkpoint) : checkpoint_(checkpoint) {}
  [[nodiscard]] bool is_loading() const override { return true; }
  void rows(const NumberRows& rows) override {
    if (rows.rows > 0 && rows.row_length > 0)
      expect(checkpoint_.reader_->read(rows), "a list has another length or other numbers");
  }
  void grid_rows(const NumberRows& all, ThreadTeam::Range /*local_rows*/,
                 std::span<const ThreadTeam::Range> held) override {
    if (!checkpoint_.segments_) return rows(all);
    expect(checkpoint_.segments_->read(all, held), "its parts have other rows or other numbers");
  }

 private:
  [[noreturn]] void refuse(std::string_view what) const override {
    checkpoint_.refuse(fmt::format("does not fit the spec: {} in the stage '{}'", what, checkpoint_.stage_));
  }

  Checkpoint& checkpoint_;
};

Checkpoint::Checkpoint(CheckpointOptions options, const ProblemSpec& spec, Listener listener, Ranks* ranks)
    : options_(std::move(options)),
      segments_(ranks == nullptr ? std::nullopt
                                 : std::optional<CheckpointSegments>(std::in_place, options_.file, *ranks)),
      file_(segments_ ? CheckpointSegments::manifest(options_.file) : options_.file),
      identity_{sha256_hex(spec.text), is_first() ? sha256_of_controller(spec) : "", program()},
      listener_(std::move(listener)),
      saved_(Clock::now()) {
  bool is_there = is_first() && take_or_make();
  if (segments_) {
    is_there = segments_->ranks().sum(is_there ? 1 : 0) > 0;
    if (is_there && !is_first()) open();
    segments_->check();
  }
  if (!options_.resume || !is_first()) return;
  listener_.notice(
      fmt::format("{} ({})", is_there ? "continuing from the checkpoint" : "no checkpoint yet, starting anew",
                  options_.file));
}

/// @returns whether it was there
bool Checkpoint::take_or_make() {
  lock_ = FileLock::take(file_, kCheckpointName);
  const bool is_there = lock_.has_value();
  if (is_there) {
    open();
  } else {
    make_first();
  }
  remove_unfinished(file_, kUnfinished);
  if (segments_) segments_->remove_others();
  return is_there;
}

/// Two processes that begin at once must not both take it for theirs.
void Checkpoint::make_first() {
  listener_.progress(true);
  try {
    OutputFile output(file_, kCheckpointName, kUnfinished);
    CheckpointWriter file(output.temporary(), options_.file, header(), [this] { listener_.progress(true); });
    file.finish();
    std::optional<FileLock> lock = FileLock::take(output.temporary(), kCheckpointName);
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
  reader_ = std::make_unique<CheckpointReader>(file_);
  if (is_first()) check_identity();
  if (segments_ && !segments_->take(*reader_)) refuse("has parts that are none");
  if (!next_record()) close();
}

void Checkpoint::close() {
  reader_.reset();
  if (segments_) segments_->close();
}

void Checkpoint::check_identity() {
  const Json header = reader_->header();
  const std::string spec = text_of(header, "spec"), controller = text_of(header, "controller"),
                    version = text_of(header, "program");
  if (version.empty()) throw ResultsError("this is no checkpoint, or a part of one", file_);
  const auto differ = [this](const char* what, const std::string& found, const std::string& expected) {
    refuse(fmt::format("was made {}: found {}, expected {}", what, found, expected));
  };
  if (spec != identity_.spec) differ("from another spec", "SHA-256 " + spec, identity_.spec);
  if (controller != identity_.controller)
    differ("with another controller", "SHA-256 " + controller, identity_.controller);
  if (version != identity_.program) differ("by another coordreq", version, identity_.program);
}

void Checkpoint::refuse(const std::string& reason) const {
  throw ResultsError("the checkpoint " + reason, options_.file);
}

/// Goes to the next record. @returns false if there is none
bool Checkpoint::next_record() {
  const std::string section = section_name(records_read_);
  const Json record = reader_->begin(section);
  if (record.is_null()) return false;
  if (segments_) segments_->read_from(section);
  ++records_read_;
  next_stage_ = text_of(record, "stage");
  const auto is_finished = record.find("finished");
  if (is_finished == record.end() || !is_finished->is_boolean())
    refuse("does not say whether a stage is over");
  next_is_finished_ = is_finished->get<bool>();
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
  // The current work is the last record of the file.
  if (!next_record()) close();
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

/// Not while there is more to take up: a new file would hold less than the old one.
bool Checkpoint::is_due() const {
  if (reader_) return false;
  if (options_.every_seconds <= 0) return true;
  const double pause = std::max(options_.every_seconds, (kShare - 1) * cost_.count());
  const bool is_due = Clock::now() - saved_ >= std::chrono::duration<double>(pause);
  return segments_ ? segments_->ranks().sum(is_first() && is_due ? 1 : 0) > 0 : is_due;
}

void Checkpoint::save(const Record* current) {
  const Clock::time_point begin = Clock::now();
  listener_.progress(true);
  try {
    segments_ ? replace_together(current) : replace(current);
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

void Checkpoint::replace(const Record* current) {
  OutputFile output(file_, kCheckpointName, kUnfinished);
  CheckpointWriter file(output.temporary(), options_.file, header(), [this] { listener_.progress(true); });
  write_records(&file, current);
  file.finish();
  commit(output);
}

/// Replaces the file; if one process fails, all of them learn of it.
void Checkpoint::replace_together(const Record* current) {
  std::optional<OutputFile> output;
  std::optional<CheckpointWriter> file;
  std::optional<IoError> failure;
  const auto attempt = [&failure](const std::function<void()>& work) {
    try {
      if (!failure) work();
    } catch (const IoError& error) {
      failure = error;
    }
  };
  attempt([&] {
    const auto progress = [this] { listener_.progress(true); };
    if (is_first()) {
      output.emplace(file_, kCheckpointName, kUnfinished);
      file.emplace(output->temporary(), options_.file, header(), progress);
    }
    segments_->start(progress);
    write_records(file ? &*file : nullptr, current);
    segments_->finish();
  });
  const bool are_written = segments_->agree(!failure);
  if (!are_written && !failure) failure.emplace("another rank cannot write its part", options_.file);
  attempt([&] {
    if (!is_first()) return;
    segments_->describe(*file);
    file->finish();
    commit(*output);
  });
  segments_->settle(segments_->ranks().sum(failure ? 1 : 0) == 0);
  if (failure) throw IoError(*failure);
}

/// The new file is locked before it has its name.
void Checkpoint::commit(OutputFile& output) {
  std::optional<FileLock> lock = FileLock::take(output.temporary(), kCheckpointName);
  output.commit();
  lock_ = std::move(lock);
}

Json Checkpoint::header() const {
  return {{"spec", identity_.spec}, {"controller", identity_.controller}, {"program", identity_.program}};
}

/// @param file null: this process writes a segment alone
void Checkpoint::write_records(CheckpointWriter* file, const Record* current) {
  std::size_t count = 0;
  const auto add = [&](const Record& record) {
    const std::string section = section_name(count++);
    if (segments_) segments_->begin(section);
    if (file != nullptr) file->begin(section, {{"stage", record.stage}, {"finished", record.is_finished}});
    Saving archive(file, segments_ ? &*segments_ : nullptr);
    record.save(archive);
  };
  for (const Record& record : finished_) add(record);
  if (current != nullptr) add(*current);
}

// A symbolic link stays, as it does when the file is written.
void Checkpoint::remove() {
  if (!is_first()) return;
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(file_, error);
  if (!error) static_cast<void>(std::filesystem::remove(file, error));
  remove_unfinished(file_, kUnfinished);
  if (!segments_) return;
  segments_->remove_all();
  // With what the user has put there it stays.
  static_cast<void>(std::filesystem::remove(options_.file, error));
}

void check_checkpoint(const CheckpointOptions& options, bool is_folder) {
  std::error_code ignored;  // what cannot be made cannot be written to either
  if (is_folder) std::filesystem::create_directory(options.file, ignored);
  const std::string file = is_folder ? CheckpointSegments::manifest(options.file) : options.file;
  const OutputFile probe(file, kCheckpointName, kUnfinished);
  if (options.resume || !std::filesystem::exists(file)) return;
  throw UsageError("the checkpoint is there already, expected --resume to continue from it, or another file",
                   options.file);
}

}  // namespace coordreq
