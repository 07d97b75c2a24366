"""What trep has published: it needs Python 2, so it is quoted here instead of run.

E. Johnson's and T. Murphey's trep is the software of reference [2] of the README. The figures are
those measured with trep 1.0 on another machine, chains and cradles as in scenes.py, steps of 10 ms.
A ratio to them tells orders of magnitude, not percents.
"""

from __future__ import annotations

from tests.bench.clock import Time

SOURCE = "measured with trep 1.0 on another machine; steps of 10 ms"

PARTIALS = {  # [us] all first and second partials of L
    "chain 8": 41,
    "chain 16": 249,
    "chain 32": 1927,
    "chain 64": 19154,
    "cradle 10": 27,
    "cradle 30": 100,
    "cradle 100": 648,
}

STEP_10MS = {  # [us] a step of h = 10 ms, three to four Newton iterations
    "chain 8": 225,
    "chain 16": 1588,
    "chain 32": 11700,
    "chain 64": 443000,
    "cradle 10": 154,
    "cradle 30": 657,
    "cradle 100": 8600,
}


def figures(model: str) -> dict[str, Time]:
    """Return the row's entries for a model of the benchmarks, if there are figures of it."""
    tables = {"trep_partials": PARTIALS, "trep_step_10ms": STEP_10MS}
    return {
        name: {"min": float(table[model]), "median": float(table[model])}
        for name, table in tables.items()
        if model in table
    }
