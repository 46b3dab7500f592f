"""What shells offer at the end of a line, asked of the shells themselves."""

import os
import pty
import select
import subprocess


def bash_offers(script, words, folder):
    """The completions of the last word; as bash splits a line, so that --a=b is three words."""
    commands = r"""
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
eval "$(complete -p coordreq | sed 's/.*-F \([^ ]*\) .*/\1/')"
printf '%s\n' "${COMPREPLY[@]}"
"""
    return _lines(["bash", "--norc", "-c", commands, "bash", script, *words], folder)


def fish_offers(script, line, folder):
    commands = 'source $argv[1]; complete -C "$argv[2]"'
    lines = _lines(["fish", "--no-config", "-c", commands, str(script), line], folder)
    return [text.split("\t")[0] for text in lines]


def _lines(command, folder):
    environment = {"PATH": os.environ["PATH"], "HOME": str(folder), "LC_ALL": "C.UTF-8"}
    result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=60)
    if result.returncode != 0 or result.stderr:
        raise AssertionError(f"{command}: {result.returncode}\n{result.stderr}")
    return sorted(line for line in result.stdout.splitlines() if line)


# Control-T prints all that the completion functions have handed to the builtin compadd.
ZSH_SETUP = r"""
PS1='' PS2='' RPS1=''
autoload -Uz compinit
compinit -D -u
source "$COMPLETION_SCRIPT"
_report() {
  local -a hits
  compadd() {
    if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
      builtin compadd "$@"
      return
    fi
    local -a found
    builtin compadd -A found "$@"
    hits+=("$found[@]")
    builtin compadd "$@"
  }
  _main_complete
  unfunction compadd
  print -rl -- '' BEGIN-OF-HITS "$hits[@]" END-OF-HITS
}
zle -C report list-choices _report
bindkey '^T' report
print SET-UP-IS-DONE
"""


class Zsh:
    """An interactive zsh on a terminal of its own: only there does zsh complete."""

    def __init__(self, script, folder):
        (folder / "setup.zsh").write_text(ZSH_SETUP, encoding="utf-8")
        environment = {
            "PATH": os.environ["PATH"],
            "HOME": str(folder),
            "LC_ALL": "C.UTF-8",
            "TERM": "dumb",
            "COMPLETION_SCRIPT": str(script),
        }
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], environment)
        self.unread = b""
        os.write(self.terminal, b"source ./setup.zsh; rm setup.zsh\n")
        self._read_until(b"SET-UP-IS-DONE\r\n")

    def offers(self, line):
        os.write(self.terminal, b"\x15" + line.encode() + b"\x14")
        self._read_until(b"BEGIN-OF-HITS\r\n")
        return sorted(name for name in self._read_until(b"END-OF-HITS\r\n").decode().split("\r\n") if name)

    def close(self):
        os.write(self.terminal, b"\x15exit\n")
        os.close(self.terminal)
        os.waitpid(self.pid, 0)

    def _read_until(self, mark):
        """What comes before the mark."""
        while mark not in self.unread:
            ready, _, _ = select.select([self.terminal], [], [], 60)
            if not ready:
                raise AssertionError(f"zsh is silent after {self.unread!r}")
            self.unread += os.read(self.terminal, 65536)
        text, self.unread = self.unread.split(mark, 1)
        return text
