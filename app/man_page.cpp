#include "app/program_help.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace coordreq {
namespace {

constexpr const char* kDescription = R"(.PP
Several agents share a safety task. While they are connected they coordinate their actions; during silence each of
them chooses alone.
.B coordreq
computes how long they may be silent, from every cell of a grid over the state space, before they must coordinate
again to stay safe.
.PP
It reads a model of the system, a SPEC in JSON, and writes one file of RESULTS, an HDF5 file that opens as
netCDF\-4. The other commands check a spec or read results. Answers go to standard output; progress,
warnings and errors go to standard error. An error is one line that says what was found, where, and what was
expected.
)";

constexpr const char* kExamples = R"(.PP
A spec to start from, and its analysis:
.PP
.RS 4
.nf
coordreq init first.json
coordreq analyze first.json
.fi
.RE
.PP
The whole analysis of a spec, written to circle.h5; the results for a state; and a check of the file by an
independent method:
.PP
.RS 4
.nf
coordreq analyze circle.json
coordreq query circle.h5 \-\-at x1=0.1,x2=0
coordreq verify circle.h5
.fi
.RE
.PP
The answer for several values of the spec, and the delay that one of them costs, cell by cell:
.PP
.RS 4
.nf
coordreq analyze circle.json \-\-sweep constants.R=0.8,0.7,0.6
coordreq analyze circle.json \-\-set constants.R=0.7 \-o smaller.h5
coordreq compare circle.h5 smaller.h5
.fi
.RE
)";

/// A text as running text: no character means anything to roff, and a hyphen is one that can be copied.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result.rfind('.', 0) == 0 || result.rfind('\'', 0) == 0 ? "\\&" + result : result;
}

/// A sentence, which descriptions of options are without their full stop.
std::string sentence(const std::string& text) {
  return roff(text) + (text.empty() || text.back() == '.' || text.back() == '?' ? "\n" : ".\n");
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

/// Literals in bold, placeholders in italics.
std::string value_text(const ValueHelp& value) {
  const std::vector<std::string> literals = value.literals();
  std::string text;
  for (std::size_t begin = 0; begin <= value.text.size();) {
    const std::size_t end = std::min(value.text.find('|', begin), value.text.size());
    const std::string term = value.text.substr(begin, end - begin);
    const bool literal = std::find(literals.begin(), literals.end(), term) != literals.end();
    text += (begin == 0 ? "" : "|") + (literal ? bold(term) : italic(term));
    begin = end + 1;
  }
  return text;
}

std::string option_entry(const OptionHelp& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.value.text.empty()) names += " " + value_text(option.value);
  return ".TP\n" + names + "\n" + sentence(option.description);
}

std::string command_heading(const std::string& program, const CommandHelp& command) {
  std::string heading = bold(program + " " + command.name);
  for (const ArgumentHelp& argument : command.arguments) {
    const std::string name = italic(argument.name) + (argument.many ? "..." : "");
    heading += " " + (argument.required ? name : "[" + name + "]");
  }
  return heading;
}

std::string command_entry(const ProgramHelp& help, const CommandHelp& command,
                          const std::vector<OptionHelp>& common) {
  std::string text =
      fmt::format(".SS {}\n{}", command_heading(help.name, command), sentence(command.description));
  for (const ArgumentHelp& argument : command.arguments) {
    text += ".TP\n" + value_text({argument.name});
    if (!argument.value.literals().empty()) text += " (" + value_text(argument.value) + ")";
    text += "\n" + sentence(argument.description);
  }
  for (const OptionHelp& option : command.options) {
    if (std::find(common.begin(), common.end(), option) == common.end()) text += option_entry(option);
  }
  return text;
}

std::string options_section(const char* title, const std::vector<OptionHelp>& options) {
  std::string text = fmt::format(".SH {}\n", title);
  for (const OptionHelp& option : options) text += option_entry(option);
  return text;
}

}  // namespace

std::string man_page(const ProgramHelp& help, std::string_view version) {
  const std::vector<OptionHelp> common = help.common_options();
  std::string text = fmt::format(".TH COORDREQ 1 \"\" \"{} {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
                                 help.name, version, help.name, roff(help.description));
  text +=
      fmt::format(".SH SYNOPSIS\n.PP\n{} {} [{}]\n", bold(help.name), italic("COMMAND"), italic("OPTIONS"));
  text += fmt::format(".SH DESCRIPTION\n{}.SH COMMANDS\n", kDescription);
  for (const CommandHelp& command : help.commands) text += command_entry(help, command, common);
  text += options_section("COMMON OPTIONS", common);
  text += options_section("OPTIONS WITHOUT A COMMAND", help.options);
  text += ".SH EXIT STATUS\n";
  for (const ExitCodeHelp& code : kExitCodes) {
    text += fmt::format(".TP\n{}\n{}", bold(std::to_string(code.code)), sentence(code.meaning));
  }
  return text + ".SH EXAMPLES\n" + kExamples;
}

}  // namespace coordreq
