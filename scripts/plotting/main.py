"""The command line of coordreq-plot, scripts/plot in the source tree."""

import argparse
import difflib
import re
import signal
import sys

from .errors import PlotError, StreamError, UsageError, quoted

_PROGRAM = "coordreq-plot"
_FIGURES = ("actions", "layers", "unsafe3d", "run", "requirements", "coalition", "goal", "risk", "sweep", "blind", "silence", "require")
_WRITERS = {"run": "simulate -o", "sweep": "analyze --sweep --json", "require": "require --json"}
_EPILOG = "Exit codes: 0 done, 2 wrong usage, 3 invalid file, 5 input or output failed, 130 interrupted."


class _Parser(argparse.ArgumentParser):
    """Complains in our words; a figure about its own arguments, so that it names its own help."""

    def parse_known_args(self, args=None, namespace=None):
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return found, unknown

    def error(self, message):
        missing = re.fullmatch(r"the following arguments are required: (.*)", message)
        if missing:
            raise UsageError(f"no {missing[1].split(', ')[0].split('/')[-1]}, {self._see_help()}")
        unknown = re.fullmatch(r"unrecognized arguments: (.*)", message)
        if unknown:
            raise UsageError(f"unknown argument '{unknown[1]}', {self._see_help()}")
        choice = re.fullmatch(r"argument FIGURE: invalid choice: '(.*)' \(choose from .*\)", message)
        if choice:
            near = difflib.get_close_matches(choice[1].lower(), _FIGURES, 1)
            hint = f"did you mean '{near[0]}'?" if near else f"expected {quoted(_FIGURES)}"
            raise UsageError(f"unknown figure '{choice[1]}', {hint}")
        option, what = re.fullmatch(r"argument ([^:]*): (.*)", message).groups()
        what = "expected a value, found none" if what == "expected one argument" else what
        raise UsageError(what, option.split("/")[-1])

    def _see_help(self):
        return f"see {self.prog} --help"


def _size(text):
    """(6.0, 4.0) of "6x4"."""
    match = re.fullmatch(r"(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)", text)
    if not match or not all(0 < float(side) <= 100 for side in match.groups()):
        raise argparse.ArgumentTypeError(f"expected WIDTHxHEIGHT in inches, found '{text}'")
    return tuple(map(float, match.groups()))


def _dpi(text):
    if not text.isdecimal() or not 10 <= int(text) <= 2400:
        raise argparse.ArgumentTypeError(f"expected a whole number from 10 to 2400, found '{text}'")
    return int(text)


def _parser(modules, program):
    epilog = f"'{program} FIGURE --help' shows the options of a figure. {_EPILOG}"
    parser = _Parser(prog=program, description="Draws figures of coordreq results.", epilog=epilog)
    commands = parser.add_subparsers(dest="figure", metavar="FIGURE", required=True)
    for name, module in modules.items():
        text = module.__doc__.strip()
        command = commands.add_parser(
            name,
            help=text.splitlines()[0],
            description=text,
            epilog=_EPILOG,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        command.add_argument("file", metavar="FILE", help=f"a file that coordreq {_WRITERS.get(name, 'analyze')} wrote")
        command.add_argument(
            "-o", "--output", required=True, metavar="PICTURE", help="file to write: .png, .svg or .pdf"
        )
        module.add_arguments(command)
        command.add_argument("--size", type=_size, metavar="WxH", help="size of the picture, inches")
        command.add_argument("--dpi", type=_dpi, default=150, help="dots per inch of a PNG (default: 150)")
    return parser


def _modules():
    """The figures by name, in an order that a reader may like."""
    try:
        import matplotlib

        matplotlib.use("Agg")
        import importlib

        return {name: importlib.import_module(f".{name}", __package__) for name in _FIGURES}
    except ModuleNotFoundError as error:
        raise StreamError(
            f"Python ({sys.executable}) has no module '{error.name}', expected h5py and matplotlib, in Debian the packages of "
            "scripts/packages.txt"
        ) from error


def parse(words, program=_PROGRAM):
    """@returns the module of the figure and its arguments"""
    modules = _modules()
    arguments = _parser(modules, program).parse_args(words)
    return modules[arguments.figure], arguments


def _run(words, program):
    module, arguments = parse(words, program)
    from .output import check_output, save

    check_output(arguments.output)
    save(module.draw(module.prepare(arguments), arguments.size), arguments.output, arguments.dpi)


def main(words, program=_PROGRAM):
    """@param program the name that it was called by
    @returns the exit code"""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        _run(words, program)
    except PlotError as error:
        print(f"{program}: error: {error}", file=sys.stderr)
        return error.code
    except KeyboardInterrupt:
        print(f"{program}: error: interrupted", file=sys.stderr)
        return 130
    return 0
