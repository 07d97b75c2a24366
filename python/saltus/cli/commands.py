"""What the commands of the command line do."""

from __future__ import annotations

import argparse
import math
import os
import textwrap
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

import saltus
from saltus.plots.figure import new_figure
from saltus.records.impacts import count_line
from saltus.records.pairs import pair_name
from saltus.records.replace import check_folder, check_target
from saltus.records.tables import counted

MOST_IMPACTS = 12  # lines of the table of impacts
MOST_IMPULSES = 4  # impulses on a line of it
INTERRUPTED = 130  # what a shell expects of a program that Ctrl-C ended


def assignment(text: str) -> tuple[str, float]:
    """Return name and value of "name=value"."""
    name, equals, value = text.partition("=")
    if not name or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form NAME=VALUE")
    try:
        return name, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{value}' in '{text}' is no number") from None


def contact(text: str) -> saltus.ContactProperties:
    """Return the properties that "E,MU" says."""
    words = text.split(",")
    if len(words) != 2:
        raise argparse.ArgumentTypeError(
            f"'{text}' is not of the form E,MU: restitution and friction, as in 0,0.5 for wood "
            "that does not bounce, or 1,0 for elastic and smooth"
        )
    try:
        restitution, friction = map(float, words)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not two numbers, as in 0,0.5") from None
    try:
        return saltus.ContactProperties(restitution=restitution, friction=friction)
    except saltus.ModelError as error:
        raise argparse.ArgumentTypeError(f"'{text}': {error}") from None


def cmake_dir(_: argparse.Namespace) -> int:
    """Print the CMake prefix of the package."""
    print(saltus.cmake_dir())
    return 0


def keep(file: str, outputs: Iterable[str | None]) -> None:
    """Raise ModelError where an output would replace the file that is read."""
    for path in outputs:
        if path and os.path.exists(path) and os.path.exists(file) and os.path.samefile(path, file):
            raise saltus.ModelError(f"{path} is the file that is read; name another to be written")


def simulate(chosen: argparse.Namespace) -> int:
    """Run a model, print its impacts and energy error, write what is asked for."""
    keep(chosen.file, (chosen.out, chosen.plot, chosen.plot_impacts))
    if chosen.out is not None:  # before a long run, not after it
        check_target(chosen.out)
    for path in (chosen.plot, chosen.plot_impacts):
        if path is not None:
            check_folder(path)
    for path in (chosen.plot, chosen.plot_impacts):
        if path is not None:
            new_figure(path, (1, 1))  # says at once, not after the run, what is missing
    try:
        run = _run(chosen)
    except saltus.StepError as error:
        before = error.trajectory
        if chosen.out and before is not None:
            before.save(chosen.out)
            print(f"trajectory, up to t = {before.t[-1]:g} s: {chosen.out}")
        raise
    _print_impacts(run, everything=chosen.all_impacts)
    print(run.summary())
    if chosen.out:
        run.save(chosen.out)
        print(f"trajectory: {chosen.out}")
    if chosen.plot:
        run.plot(chosen.plot)
        print(f"picture: {chosen.plot}")
    if chosen.plot_impacts:
        run.plot_impacts(chosen.plot_impacts)
        print(f"picture of impacts: {chosen.plot_impacts}")
    return 0 if run.complete else INTERRUPTED


def first_state(model: saltus.Model, q: dict[str, float], v: dict[str, float]) -> saltus.State:
    """Return the state to start from; loops are closed, and what is set stays where it can."""
    if not model.loop_names:
        return model.state(q, v)
    kept = [name for name in {**q, **v} if name in model.velocity_names]
    return saltus.close_loops(model, q, v, keep=kept)


def _run(chosen: argparse.Namespace) -> saltus.Trajectory:
    model = load(chosen, visuals=chosen.out is not None)  # the file is what pictures are made of
    return saltus.simulate(
        model,
        state=first_state(model, dict(chosen.q), dict(chosen.v)),
        duration=chosen.duration,
        h=chosen.h,
        law=chosen.law,
        order=chosen.order,
        certify=True,
        collisions=not chosen.no_collisions,
        record_every=chosen.record_every,
        record_contacts=chosen.contacts,
    )


def info(chosen: argparse.Namespace) -> int:
    """Print what a model consists of."""
    model = load(chosen)
    mass = sum(link.mass for link in model.links)
    counts = {
        "link": len(model.links),
        "joint": len(model.joints),
        "coordinate": model.n_q,
        "velocity": model.n_v,
        "shape": len(model.shapes),
        "gap": model.n_pairs,
    }
    parts = [counted(number, noun) for noun, number in counts.items()]
    print(f"{model.name}: {', '.join(parts)}, {mass:g} kg")
    _print_solvers(model)
    print(f"default contact: {_in_words(model.default_contact)}")
    print("\nlinks, each after its joint")
    print(textwrap.indent("\n".join(saltus.model_tree(model).splitlines()[1:]), "  "))
    _print_coordinates(model)
    if model.control_names:
        limits = zip(model.control_names, model.control_limits, strict=True)
        rows = ([name, *("" if math.isinf(x) else f"{x:g}" for x in pair)] for name, pair in limits)
        _print_table("actuators", ["name", "control from", "to"], rows)
    for title, names in (
        ("loops", model.loop_names),
        ("states", model.state_names),
        ("sensors", model.sensor_names),
    ):
        if names:
            _print_table(title, ["name"], ([name] for name in names))
    _print_table(
        "shapes",
        ["name", "shape", "link"],
        ([s.name, repr(s.shape), model.links[s.link].name] for s in model.shapes),
    )
    _print_pair_kinds(model)
    if chosen.pairs:
        pairs = Counter((min(gap.a, gap.b), max(gap.a, gap.b)) for gap in model.pairs)
        rows = ([pair_name(model, pair), _kind(model, pair), str(n)] for pair, n in pairs.items())
        _print_table("pairs", ["name", "kind", "gaps"], rows)
    if chosen.gaps:
        _print_table("gaps", ["name"], ([name] for name in model.pair_names))
    return 0


def load(chosen: argparse.Namespace, *, visuals: bool = False) -> saltus.Model:
    """Return the model of the file; visuals are for who looks at it."""
    # Paths, whatever their names begin with: text is for programs.
    return saltus.load_urdf(
        str(Path(chosen.file).absolute()),
        root_joint="floating" if chosen.floating else "fixed",
        meshes="none" if chosen.no_meshes else "hull",
        srdf=str(Path(chosen.srdf).absolute()) if chosen.srdf else None,
        contact=chosen.contact,
        floor=chosen.floor,
        visuals=visuals,
        inertia=chosen.inertia,
        strict=chosen.strict,
    )


def _print_impacts(run: saltus.Trajectory, *, everything: bool) -> None:
    shown = len(run.impacts) if everything else min(len(run.impacts), MOST_IMPACTS)
    if shown:
        print("     t [s]  pairs in order (λ [N s])")
    for i in range(shown):
        impact = run.impact(i)
        most = len(impact.pairs) if everything else MOST_IMPULSES
        impulses = [
            f"{pair} ({value:.4g})"
            for pair, value in zip(impact.pairs[:most], impact.lambdas[:most], strict=True)
        ]
        if len(impact.pairs) > most:
            impulses.append(f"... {len(impact.pairs) - most} more")
        print(f"{impact.t:10.6f}  {', '.join(impulses)}")
        if impact.contacts > 1:
            print(f"{'':10}    {count_line(impact)}")
    if shown < len(run.impacts):
        left = len(run.impacts) - shown
        print(f"{'':10}  ... {left} more impact{'s' * (left > 1)} (--all-impacts prints them)")


def _print_solvers(model: saltus.Model) -> None:
    def words(tree: saltus.TreeSolution) -> str:
        lanes = f", {tree.trees} equal trees in lanes" if tree.trees > 1 else ""
        return f"{tree.solver.name} (depth {tree.depth}{lanes})"

    counts = Counter(words(tree) for tree in model.solvers)
    texts = [f"{count} x {text}" if count > 1 else text for text, count in counts.items()]
    print(f"solver: {', '.join(texts) or 'none, nothing moves'}")


def _in_words(properties: saltus.ContactProperties | None) -> str:
    if properties is None:
        return "elastic and without friction, because nothing is said of it"
    return f"restitution {properties.restitution:g}, friction {properties.friction:g}"


def _print_coordinates(model: saltus.Model) -> None:
    def limit(x: float) -> str:
        return "" if math.isinf(x) else f"{x:g}"

    rows = ([c.name, c.joint, c.unit, limit(c.lower), limit(c.upper)] for c in model.coordinates)
    _print_table("coordinates", ["name", "joint", "unit", "lower", "upper"], rows)


def _kind(model: saltus.Model, pair: tuple[int, int]) -> str:
    return " ~ ".join(sorted(saltus.shape_name(model.shapes[i].shape) for i in pair))


def _print_pair_kinds(model: saltus.Model) -> None:
    rows = ([f"{a} ~ {b}", str(count)] for (a, b), count in sorted(model.pair_kinds().items()))
    _print_table("kinds of pairs", ["kind", "gaps in this model"], rows)


def _print_table(title: str, heads: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    lines = [list(heads), *rows]
    told = [i for i in range(len(heads)) if any(line[i] for line in lines[1:])]
    lines = [[line[i] for i in told] for line in lines] if told else lines[:1]
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    if len(lines) == 1:
        print(f"\n{title}: none")
        return
    print(f"\n{title}")
    for line in lines:
        cells = (cell.ljust(width) for cell, width in zip(line, widths, strict=True))
        print(("  " + "  ".join(cells)).rstrip())
