#include "app/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/option_values.hpp"
#include "app/text.hpp"
#include "base/error.hpp"
#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr double kReadingBytes = 1024 * 1024;  // buffers and tables of the smallest files

}  // namespace

void Options::argument(std::string& target, const char* name, const char* description, const char* takes) {
  Argument& argument = arguments_.emplace_back(Argument{.name = name, .takes = takes, .one = &target});
  command_.add_option(name, target, description)->required()->type_name(argument.takes);
}

void Options::optional_argument(std::string& target, const char* name, const char* description,
                                const std::string& takes) {
  arguments_.emplace_back(Argument{.name = name, .takes = takes, .is_required = false, .one = &target});
  command_.add_option(name, target, description)->type_name(takes);
}

void Options::arguments(std::vector<std::string>& target, const char* name, const char* description) {
  arguments_.emplace_back(Argument{.name = name, .all = &target});
  command_.add_option(name, target, description)->required()->type_name("");
}

void Options::flag(const char* name, const char* description, std::function<void()> take) {
  Entry& entry = entries_.emplace_back();
  entry.option = command_.add_flag(name, entry.is_given, description)->disable_flag_override();
  entry.take = [take = std::move(take)](const auto&, const auto&) { take(); };
}

void Options::flag(bool& target, const char* name, const char* description) {
  flag(name, description, [&target] { target = true; });
}

void Options::option(const char* names, const char* takes, const char* description, Take take) {
  add(names, takes, description, false, std::move(take));
}

void Options::option_with_or_without(const char* names, const char* takes, const char* description,
                                     Take take) {
  add(names, takes, description, false, std::move(take));
  entries_.back().option->expected(0, 1);
}

void Options::add(const char* names, const char* takes, const char* description, bool repeatable, Take take) {
  Entry& entry = entries_.emplace_back();
  entry.take = std::move(take);
  if (repeatable) {
    entry.option = command_.add_option(names, entry.texts, description)->expected(1)->take_all();
  } else {
    entry.option = command_.add_option(names, entry.text, description);
  }
  entry.option->type_name(takes);
}

void Options::read_values() {
  REQUIRES(command_.parsed());
  for (const Entry& entry : entries_) {
    if (entry.option->count() == 0) continue;
    const std::string name = "--" + entry.option->get_lnames().front();
    const auto take = [&](const std::string& text) {
      // The parser takes whatever follows an option that needs a value.
      if (text.starts_with('-') && command_.get_option_no_throw(text) != nullptr)
        throw UsageError(fmt::format("expected a value, found the option {}", echoed(text)), name);
      entry.take(text, name);
    };
    if (entry.texts.empty()) take(entry.text);
    for (const std::string& text : entry.texts) take(text);
  }
}

std::optional<std::uint64_t> CommonOptions::memory() const {
  std::optional<std::uint64_t> memory = max_memory;
  if (!memory) memory = available_memory();
  if (memory && !max_memory) *memory /= static_cast<std::uint64_t>(sharers);
  return memory;
}

void CommonOptions::hold_to_memory() const {
  if (max_memory) coordreq::hold_to_memory(*max_memory);
}

void CommonOptions::keep_to_memory() const {
  expect_memory("reading results needs at least", kReadingBytes, max_memory);
  hold_to_memory();
}

int CommonOptions::threads_for(const std::string& subject, const MemoryDemand& demand) const {
  return threads_within(subject, demand, threads, memory());
}

void declare_threads(Options& options, int& threads, const char* description) {
  constexpr int kMostThreads = 1024;
  options.option(threads, "--threads", "N", description, WholeNumber<int>{1, kMostThreads});
}

void declare_common(Options& options, CommonOptions& common, const CommonUse& use) {
  if (use.threads)
    declare_threads(options, common.threads,
                    "Number of threads (default: all processors that the process may use)");
  if (use.memory)
    options.option(
        common.max_memory, "--max-memory", "SIZE",
        "Memory limit, e.g. 500M or 1.5G; larger work is refused (default: the memory of the machine)",
        memory_size);
  if (!use.answer) return;
  options.flag(common.json, "--json", "Print one JSON document instead of text");
  options.flag(common.quiet, "--quiet", "No text summary, no progress");
}

void declare_results(Options& options, std::string& path) {
  options.argument(path, "RESULTS", "A file that analyze wrote");
}

}  // namespace coordreq
