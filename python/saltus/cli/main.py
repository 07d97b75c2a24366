"""The command line: `saltus simulate`, `info`, `view` and `cmake-dir`."""

from __future__ import annotations

import argparse
import os
import sys
import warnings
from collections.abc import Sequence
from typing import NoReturn, TextIO

import saltus
from saltus.cli import commands, looking

USER_ERROR, STEP_ERROR = 2, 1


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line; usage is what --help is for."""

    def error(self, message: str) -> NoReturn:
        """Print the message and end the program."""
        self.exit(USER_ERROR, f"{self.prog}: {message} (see {self.prog} --help)\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the program where there are none.

    Returns
    -------
    int
        0; 2 on an error of the user's, 1 where a step failed, 130 after Ctrl-C.
    """
    chosen = make_parser().parse_args(arguments)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            code: int = chosen.command(chosen)
    except (saltus.ModelError, OSError) as error:
        if isinstance(error, BrokenPipeError):  # as in: saltus info FILE | head
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 0
        return _fail(error, USER_ERROR)
    except saltus.StepError as error:
        return _fail(error, STEP_ERROR)
    except KeyboardInterrupt:
        return commands.INTERRUPTED
    return code


def make_parser() -> argparse.ArgumentParser:
    """Return the parser with all commands."""
    parser = Parser(prog="saltus", description=(saltus.__doc__ or "").splitlines()[0])
    parser.add_argument("--version", action="version", version=f"saltus {saltus.__version__}")
    commands_of = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")
    _add_simulate(commands_of)
    _add_info(commands_of)
    _add_view(commands_of)
    where = commands_of.add_parser(
        "cmake-dir", help="print the folder to put on CMAKE_PREFIX_PATH for find_package(saltus)"
    )
    where.set_defaults(command=commands.cmake_dir)
    return parser


Commands = argparse._SubParsersAction  # what add_subparsers returns has no public name


def _add_simulate(commands_of: Commands[Parser]) -> None:
    parser = commands_of.add_parser(
        "simulate",
        help="run a model and report its impacts",
        description="Run a model from a URDF file, print its impacts and the energy error.",
    )
    parser.add_argument("file", metavar="FILE", help="URDF file")
    _add_start(parser)
    add = parser.add_argument
    add(
        "--law",
        choices=[law.name for law in saltus.ImpactLaw if law is not saltus.ImpactLaw.custom],
        default=saltus.ImpactLaw.nodal_energy.name,
        help="which energy impacts conserve; default: %(default)s",
    )
    add(
        "--order",
        choices=[order.name for order in saltus.ImpactOrder],
        default=saltus.ImpactOrder.fastest.name,
        help="which approaching contact takes the next impulse; default: %(default)s",
    )
    add("--record-every", type=int, default=1, metavar="N", help="steps between recorded rows")
    add("--contacts", action="store_true", help="--out has every impulse between bodies as well")
    add("--no-collisions", action="store_true", help="bodies pass through each other")
    add("--out", metavar="FILE.h5", help="write the trajectory to this HDF5 file")
    add("--plot", metavar="FILE.png", help="write a picture; the suffix selects the format")
    add(
        "--plot-impacts",
        metavar="FILE.png",
        help="write a picture of the impacts: which pairs, when, how strong, in which order",
    )
    add("--all-impacts", action="store_true", help="print every impact and every impulse")
    _add_loading(parser)
    parser.set_defaults(command=commands.simulate)


def _add_info(commands_of: Commands[Parser]) -> None:
    parser = commands_of.add_parser(
        "info",
        help="print the parts of a model",
        description="Print links, coordinates, shapes and pairs of a URDF file, and how its "
        "trees are solved.",
    )
    parser.add_argument("file", metavar="FILE", help="URDF file")
    parser.add_argument(
        "--pairs", action="store_true", help="print every pair, and how many gaps it has"
    )
    parser.add_argument(
        "--gaps", action="store_true", help="print the name of every gap: pairs by their parts"
    )
    _add_loading(parser)
    parser.set_defaults(command=commands.info)


def _add_view(commands_of: Commands[Parser]) -> None:
    parser = commands_of.add_parser(
        "view",
        help="show a model or a recorded run in a browser",
        description="Simulate a URDF file, or read a recorded run, and show it as a page that "
        "plays. A model that is at rest as it stands is started with a joint moved a little.",
    )
    add = parser.add_argument
    add("file", metavar="FILE", help="URDF file, or a run as simulate --out writes it (.h5)")
    add("--html", metavar="FILE.html", help="write the page to this file and open no browser")
    add("--video", metavar="FILE.webm", help="write a video, which needs Chromium")
    add("--rate", type=float, default=30.0, metavar="N", help="frames a second of the video")
    add("--slow", type=float, default=1.0, metavar="N", help="the video runs N times slower")
    add(
        "--live",
        action="store_true",
        help="simulate while the page is open: joints on sliders, bodies pulled with the mouse",
    )
    add("--no-browser", action="store_true", help="with --live: print the page's address only")
    _add_start(parser, h=None, duration=None)  # a recorded run has its own, and live h is another
    _add_loading(parser)
    parser.set_defaults(command=looking.view)


def _add_start(parser: Parser, h: float | None = 0.01, duration: float | None = 10.0) -> None:
    add = parser.add_argument
    add(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        type=commands.assignment,
        dest="q",
        help="coordinate at the start [rad | m]; may be repeated, the others are 0",
    )
    add(
        "--set-velocity",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        type=commands.assignment,
        dest="v",
        help="velocity at the start [rad/s | m/s]; may be repeated, the others are 0",
    )
    add("--duration", type=float, default=duration, metavar="S", help="[s] default: 10")
    live = "" if h else ", live 1/120"
    add("--h", type=float, default=h, metavar="S", help=f"[s] time step; default: 0.01{live}")


def _add_loading(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--floating", action="store_true", help="the root link is free instead of fixed")
    add("--floor", action="store_true", help="a floor at z = 0, unless the file has it")
    add(
        "--contact",
        metavar="E,MU",
        type=commands.contact,
        help="restitution and friction of the default contact, as in 0,0.5",
    )
    add("--srdf", metavar="FILE", help="SRDF file that says which links never collide")
    add("--no-meshes", action="store_true", help="collision meshes are not used")
    add(
        "--inertia",
        choices=[use.name for use in saltus.InertiaUse],
        default=saltus.InertiaUse.checked.name,
        help="where inertias of links come from; default: %(default)s",
    )
    add("--strict", action="store_true", help="what is wrong in the file is an error, no warning")


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Print a warning without the place in this program that issued it."""
    print(f"saltus: {category.__name__}: {message}", file=sys.stderr)


def _fail(error: Exception, code: int) -> int:
    print(f"saltus: {error}", file=sys.stderr)
    return code
