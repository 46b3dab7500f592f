#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/process_memory.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace coordreq {

/// The arguments and options of one command, which declares each where it is used and says what its value
/// stands for. The help, the manual page and the completions of shells are read off them.
///
/// Values are read once the whole line has been understood, in the order of declaration. A reader
/// (option_values.hpp) is given the text and the long name of the option, and throws UsageError with that as
/// the location. What is read into must outlive this object's use by the parser.
class Options {
 public:
  using Take = std::function<void(const std::string& text, const std::string& option)>;

  /// An argument without the name of an option.
  struct Argument {
    std::string name;   ///< "SPEC"
    std::string takes;  ///< literals, or the kind of file; empty: the kind is the name
    bool is_required = true;
    std::vector<std::string>* all = nullptr;  ///< where they go: one or more of them,
    std::string* one = nullptr;               ///< or one
  };

  explicit Options(CLI::App& command) : command_(command) {}
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  void argument(std::string& target, const char* name, const char* description, const char* takes = "");
  /// May be left out; the last argument then.
  void optional_argument(std::string& target, const char* name, const char* description,
                         const std::string& takes = "");
  /// One or more; the last argument then.
  void arguments(std::vector<std::string>& target, const char* name, const char* description);

  void flag(const char* name, const char* description, std::function<void()> take);
  void flag(bool& target, const char* name, const char* description);

  void option(const char* names, const char* takes, const char* description, Take take);
  template <class Target, class Read>
  void option(Target& target, const char* names, const char* takes, const char* description, Read read) {
    option(names, takes, description,
           [&target, read = std::move(read)](const auto& text, const auto& option) {
             target = read(text, option);
           });
  }
  /// May stand alone: then its text is empty.
  void option_with_or_without(const char* names, const char* takes, const char* description, Take take);
  /// May be given several times.
  template <class Element, class Read>
  void repeatable(std::vector<Element>& target, const char* names, const char* takes, const char* description,
                  Read read) {
    add(names, takes, description, true,
        [&target, read = std::move(read)](const auto& text, const auto& option) {
          target.push_back(read(text, option));
        });
  }

  // For the parser's side.
  [[nodiscard]] const std::list<Argument>& argument_list() const { return arguments_; }
  /// @pre the line has been parsed. @pre unchecked: every argument is there. @throws UsageError
  void read_values();

 private:
  struct Entry {
    CLI::Option* option = nullptr;
    bool is_given = false;           ///< of a flag
    std::string text;                ///< of one that is not repeatable
    std::vector<std::string> texts;  ///< of one that is
    Take take;
  };
  void add(const char* names, const char* takes, const char* description, bool repeatable, Take take);

  CLI::App& command_;
  std::list<Argument> arguments_;  // lists: the parser keeps addresses
  std::list<Entry> entries_;
};

/// Which of the common options a command has a use for.
struct CommonUse {
  bool threads = true;
  bool memory = true;
  bool answer = true;  ///< --json and --quiet
};

/// The options of most commands.
struct CommonOptions {
  int threads = 0;                          ///< 0: all usable processors
  std::optional<std::uint64_t> max_memory;  ///< bytes
  bool json = false;
  bool quiet = false;

  int sharers = 1;  ///< processes that share the memory of the machine

  /// Limit of memory: --max-memory, else the share of the machine's memory for this process.
  [[nodiscard]] std::optional<std::uint64_t> memory() const;
  /// From now on no more than --max-memory is taken, if it was given.
  void hold_to_memory() const;
  /// For what reads results: the same. @throws LimitError if reading any file takes more
  void keep_to_memory() const;
  /// Asks for room for what such work takes, with --threads or as many as there is room for:
  /// threads_within().
  [[nodiscard]] int threads_for(const std::string& subject, const MemoryDemand& demand) const;
};

/// Declares --threads alone of the common options.
void declare_threads(Options& options, int& threads, const char* description);
/// To be declared last.
void declare_common(Options& options, CommonOptions& common, const CommonUse& use = {});
/// The argument RESULTS.
void declare_results(Options& options, std::string& path);

}  // namespace coordreq
