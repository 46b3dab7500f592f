#include "app/program_help.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <sstream>

namespace coordreq {
namespace {

bool is_literal(const std::string& term) {
  return !term.empty() &&
         std::none_of(term.begin(), term.end(), [](unsigned char c) { return std::isupper(c); });
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
}

OptionHelp read_option(const CLI::Option& option) {
  OptionHelp help;
  for (const std::string& name : option.get_snames()) help.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) help.value.text = option.get_type_name();
  help.description = option.get_description();
  help.repeatable = takes_many(option);
  return help;
}

std::vector<OptionHelp> read_options(const CLI::App& app) {
  std::vector<OptionHelp> options;
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional()) options.push_back(read_option(*option));
  }
  return options;
}

CommandHelp read_command(const CLI::App& command) {
  CommandHelp help{
      .name = command.get_name(), .description = command.get_description(), .options = read_options(command)};
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name(true);
    const std::string takes = option->get_type_name();
    help.arguments.push_back({name,
                              {takes.empty() ? name : takes},
                              option->get_description(),
                              takes_many(*option),
                              option->get_required()});
  }
  return help;
}

}  // namespace

std::vector<std::string> ValueHelp::literals() const {
  std::vector<std::string> literals;
  std::istringstream terms(text);
  for (std::string term; std::getline(terms, term, '|');) {
    if (is_literal(term)) literals.push_back(term);
  }
  return literals;
}

std::string ValueHelp::file_pattern() const {
  if (text == "SPEC") return "*.json";
  if (text == "RESULTS") return "*.h5";
  return text == "FILE" ? "*" : "";
}

std::vector<OptionHelp> ProgramHelp::common_options() const {
  std::vector<OptionHelp> common = commands.front().options;
  for (const CommandHelp& command : commands) {
    for (const OptionHelp& option : command.options)
      if (std::find(common.begin(), common.end(), option) == common.end()) common.push_back(option);
  }
  std::erase_if(common, [this](const OptionHelp& option) {
    const auto users = std::count_if(commands.begin(), commands.end(), [&](const CommandHelp& command) {
      return std::find(command.options.begin(), command.options.end(), option) != command.options.end();
    });
    return 2 * static_cast<std::size_t>(users) < commands.size();
  });
  return common;
}

ProgramHelp read_help(const CLI::App& app) {
  ProgramHelp help{
      .name = app.get_name(), .description = app.get_description(), .options = read_options(app)};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    help.commands.push_back(read_command(*command));
  }
  return help;
}

}  // namespace coordreq
