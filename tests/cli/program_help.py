"""What `--help` says, read back as data."""

import re


def commands(program_help):
    """{command: its description}"""
    listed = program_help.split("Subcommands:\n")[1].split("\n\n")[0]
    return dict(re.findall(r"^  (\S+) +(.*)$", listed, re.M))


def options(help_text):
    """{long name: (what it takes or '', its description)}; the descriptions of CLI11 are on the same line."""
    listed = help_text.split("\nOptions:\n")[1].split("\n\n")[0]
    listed = re.sub(r"\n {20,}", "  ", listed)  # the description of a long name is on the next line
    found = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?: (\S+))?(?: \.\.\.)?  +(.*)$", listed, re.M)
    return {name: (value, description) for name, value, description in found}


def arguments(help_text):
    """[(name, whether there may be many, whether there must be one, description)] of the positional arguments."""
    if "\nPositionals:\n" not in help_text:
        return []
    listed = help_text.split("\nPositionals:\n")[1].split("\n\n")[0]
    listed = re.sub(r"\n {20,}", "  ", listed)
    found = re.findall(r"(?m)^  (\S+)( \.\.\.)?(?: (?!REQUIRED)\S+)?( REQUIRED)?\s{2,}(.*)$", listed)
    return [(name, bool(many), bool(required), description) for name, many, required, description in found]
