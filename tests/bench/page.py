"""The manual's page on speed, from the benchmarks' results."""

from __future__ import annotations

from pathlib import Path

from tests.bench import collisions, contact, derivatives, picture, table

PAGE = """\
# Speed

Without contact a step costs as much as one of MuJoCo or a part of it. Where bodies rest on each
other a simulated second costs up to a few times as much, next to nothing once all stand still, and
many times as much in a heap that falls: for many loose bodies whose motion need not be exact a soft
engine is the better choice.

This page compares the speed of saltus with engines that solve the same equations of motion. The
numbers come from one machine, those of each section from one run. The program that measures them
writes the page. To measure again, in a checkout:

    sh tests/bench/run.sh                                # the tables below, for this machine
    sh tests/bench/run.sh --page python/docs/speed.md    # this page and its picture

The first run downloads the other engines and compiles the programs. Engines that are not installed
are left out, and named.

## What was measured

{notes}
{picture}
## Partials and steps

{how}

{ratios}

A ratio without a number means that the engine was not installed, or was too slow to be measured, or
(trep) has published none. A step of 10 ms without a time means that Newton's method did not
converge: long chains and fast arms swing too fast for it.

How times grow with n, as exponents:

{growth}

## Impacts

A cradle of touching balls, the first let go at 0.3 rad, for 5 s; medians [µs] of the steps with an
impact and of those without. All contacts of an impact are one cascade of impulses, and the step is
made of an arc before it and one after it.

{impacts}

The same cradle of three for a minute, beside an engine whose contacts are springs. An exact cradle
has an energy error of 0, and its middle ball rests. [More engines](compare.md) have a page.

{emblem}

## Derivatives of steps

{derivatives}

## Where contact is

Boxes beside each other cost about as much a second as with a soft engine, what is stacked a few
times as much; a heap that falls costs many times more, because its contacts are exact and its
impacts are located.

{contact}

## Collisions

{collisions}

## Batches

`simulate_batch` over threads. For comparison, the speed-up of a loop of multiply-adds in registers
shows how much a second thread gains on this machine.

{batch}

## All times

The times behind the ratios, in µs.

{times}
"""


def markdown(results: dict, image: str | None) -> str:
    """Return the page; `image` is the name of its picture."""
    shown = f"\n![Time of a step against the number of coordinates]({image})\n" if image else ""
    return PAGE.format(
        notes=table.bullets(table.notes(results)),
        picture=shown,
        how=table.HOW,
        ratios=table.ratios(results),
        growth=table.growth(results["growth"]) or "(not measured)",
        impacts=table.impacts(results["impacts"]),
        derivatives=derivatives.markdown(results.get("derivatives")),
        contact=contact.markdown(results.get("contact")),
        collisions=collisions.markdown(results.get("collisions")),
        batch=table.batch(results["batch"]) or "(not measured)",
        emblem=table.emblem(results["emblem"]),
        times=table.times(results["rows"]),
    )


def write(results: dict, file: Path) -> None:
    """Write the page to `file` and its picture beside it, if there is matplotlib."""
    image = file.with_suffix(".png")
    drawn = picture.write(results["rows"], image)
    file.write_text(markdown(results, image.name if drawn else None))
