"""How times relate to sizes: flop counts, and exponents of growth."""

from __future__ import annotations

import math

FLOPS_A_JOINT = 480  # the two passes that give every joint its composite and its products
FLOPS_A_PAIR = 54  # the entries of L_vv, L_qq and L_vq for a joint and one above it, or itself

# What grows how: kind of model, n of the smallest and of the largest, names of times.
SPANS = (
    ("chain", 32, 256, ("partials", "step")),
    ("chain", 16, 256, ("newton",)),
    ("cradle", 60, 2000, ("partials", "step", "newton")),
)


def partials_flops(joints: int, pairs: int) -> int:
    """Return the flops of all first and second partials of L on a tree."""
    return FLOPS_A_JOINT * joints + FLOPS_A_PAIR * pairs


def growth(rows: list[dict]) -> list[dict]:
    """Return exponents e of time ~ n^e, where both ends of a span were measured."""
    entries = []
    for kind, first, last, names in SPANS:
        ends = [r for n in (first, last) for r in rows if r["kind"] == kind and r["n"] == n]
        for name in names:
            if len(ends) != 2 or not all(name in row for row in ends):
                continue
            small, large = (row[name]["min"] for row in ends)
            exponent = math.log(large / small) / math.log(last / first)
            entry = {"name": name, "kind": kind, "first": first, "last": last}
            entries.append({**entry, "exponent": exponent})
    return entries
