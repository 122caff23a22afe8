#!/usr/bin/env python3
"""Manual pages and shell completion (bash, zsh, fish) of the program, from its own `--help`.

    packaging/terminal.py --program build/bin/ripstop --version 1.2.3 --out build/terminal
"""
import argparse
import gzip
import pathlib
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "docs/site"))
import reference  # noqa: E402

BASH = """# Completion of ripstop for bash, made from its --help.
_ripstop() {
  local current="${COMP_WORDS[COMP_CWORD]}" command="" word words=""
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$command/$word" in @PATHS@) command="$command/$word" ;; esac
  done
  COMPREPLY=()
  case "$command:${COMP_WORDS[COMP_CWORD-1]}" in
@CHOICES@
  esac
  case "$command" in
@COMMANDS@
  esac
  [[ -z "$words" || "$command" == */* && "$current" != -* && "$words" == -* ]] || COMPREPLY=($(compgen -W "$words" -- "$current"))
}
complete -o default -F _ripstop ripstop
"""

ZSH = """#compdef ripstop
# Completion of ripstop for zsh, made from its --help.
_ripstop() {
  local command="" word
  local -a commands options
  for word in "${(@)words[2,CURRENT-1]}"; do
    case "$command/$word" in (@PATHS@) command="$command/$word" ;; esac
  done
  case "$command:${words[CURRENT-1]}" in
@CHOICES@
  esac
  case "$command" in
@COMMANDS@
  esac
  if [[ "$PREFIX" == -* ]]; then _describe -o option options
  elif (( $#commands )); then _describe command commands
  else _files; fi
}
_ripstop "$@"
"""


class Command:
    """One command, or a group of commands, as its help describes it."""

    def __init__(self, path, text):
        self.path = path
        self.head, rows, self.footer = reference.sections(text)
        self.positionals = rows.get("Positionals", [])
        self.options = [(name.split(" ")[0].split(","), name.partition(" ")[2], meaning) for name, meaning in rows.get("Options", [])]
        self.commands = rows.get("Subcommands", [])

    def choices(self):
        """Options with a list of words as values."""
        for names, kind, _ in self.options:
            words = kind.split(" ")[0].split("|")
            if all(re.fullmatch(r"[a-z][a-z0-9-]*", word) for word in words):
                yield names, words


def roff(text):
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.MULTILINE)


def manual(command, version, others):
    name = "-".join(["ripstop", *command.path])
    usage = "".join(f" \\fI{roff(row.split(' ')[0])}\\fR" for row, _ in command.positionals) if not command.commands else " \\fICOMMAND\\fR"
    lines = [f'.TH "{name.upper()}" 1 "" "Ripstop {version}" "User Commands"', ".SH NAME", f"{roff(name)} \\- {roff(command.head)}",
             ".SH SYNOPSIS", f".B {roff(' '.join(['ripstop', *command.path]))}", f"[\\fIOPTIONS\\fR]{usage}"]

    def rows(title, entries):
        if entries:
            lines.append(f".SH {title}")
            for term, meaning in entries:
                lines.extend([".TP", f".B {roff(term)}", roff(meaning)])

    rows("ARGUMENTS", command.positionals)
    rows("COMMANDS", command.commands)
    rows("OPTIONS", [(f"{', '.join(names)} {kind}".strip(), meaning) for names, kind, meaning in command.options])
    if command.footer:
        notes, _, example = command.footer.partition("Example:")
        if notes.strip():
            lines += [".SH NOTES", roff(notes.strip())]
        if example:
            lines += [".SH EXAMPLES", ".nf", roff(re.sub(r"^\s{0,9}", "", example, flags=re.MULTILINE).strip()), ".fi"]
    lines += [".SH SEE ALSO", ", ".join(f"\\fB{roff(other)}\\fR(1)" for other in others if other != name)]
    return "\n".join(lines) + "\n"


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def shell(template, commands, entry, choice):
    paths = "|".join("/" + "/".join(command.path) for command in commands if command.path)
    choices = [choice("/".join(["", *command.path]), name, words) for command in commands for names, words in command.choices() for name in names]
    blocks = [entry("/".join(["", *command.path]), command) for command in commands]
    return template.replace("@PATHS@", paths).replace("@CHOICES@", "\n".join(choices)).replace("@COMMANDS@", "\n".join(blocks))


def bash(commands):
    def entry(path, command):
        words = [name for name, _ in command.commands] + [name for names, _, _ in command.options for name in names]
        return f"    {quoted(path)}) words={quoted(' '.join(words))} ;;"

    def choice(path, name, words):
        return f"    {quoted(f'{path}:{name}')}) COMPREPLY=($(compgen -W {quoted(' '.join(words))} -- \"$current\")); return ;;"

    return shell(BASH, commands, entry, choice)


def zsh(commands):
    def described(entries):
        return " ".join(quoted(f"{name}:{meaning}") for name, meaning in entries)

    def entry(path, command):
        options = [(name, meaning) for names, _, meaning in command.options for name in names]
        return f"    ({quoted(path)}) commands=({described(command.commands)}); options=({described(options)}) ;;"

    def choice(path, name, words):
        return f"    ({quoted(f'{path}:{name}')}) compadd -- {' '.join(words)}; return ;;"

    return shell(ZSH, commands, entry, choice)


def fish(commands):
    lines = ["# Completion of ripstop for fish, made from its --help."]
    for command in commands:
        seen = f"__fish_seen_subcommand_from {command.path[-1]}" if command.path else "__fish_use_subcommand"
        inner = " ".join(name for name, _ in command.commands)
        if command.path and inner:
            seen += f"; and not __fish_seen_subcommand_from {inner}"
        for name, meaning in command.commands:
            lines.append(f"complete -c ripstop -n {quoted(seen)} -f -a {name} -d {quoted(meaning)}")
        choices = {names[-1]: words for names, words in command.choices()}
        for names, kind, meaning in command.options:
            flags = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in names)
            values = f" -x -a {quoted(' '.join(choices[names[-1]]))}" if names[-1] in choices else " -r" if kind[:1].isupper() else ""
            values = "" if kind.startswith(("Excludes", "Needs")) else values
            lines.append(f"complete -c ripstop -n {quoted(seen)} {flags}{values} -d {quoted(meaning)}")
    return "\n".join(lines) + "\n"


def every_command(program, path=()):
    """All commands, groups before their own."""
    command = Command(path, reference.help_of(program, path))
    yield command
    for name, _ in command.commands:
        yield from every_command(program, (*path, name))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    options = parser.parse_args()
    commands = list(every_command(options.program))
    names = ["-".join(["ripstop", *command.path]) for command in commands]
    files = {f"man1/{name}.1.gz": gzip.compress(manual(command, options.version, names).encode(), mtime=0)
             for name, command in zip(names, commands)}
    files |= {"bash/ripstop": bash(commands).encode(), "zsh/_ripstop": zsh(commands).encode(), "fish/ripstop.fish": fish(commands).encode()}
    for name, data in files.items():
        path = options.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


if __name__ == "__main__":
    main()
