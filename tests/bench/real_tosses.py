"""Recorded tosses of a real cube beside saltus and other engines, each fitted on half of them.

The tosses are no part of saltus: their folder is an argument. Engines that are not installed are
left out. With the usual budget it takes two hours on one core; --every 8 --budget 20 shows in a few
minutes that all runs.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from tests.bench.tosses import compare, data, processes, report


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.bench.real_tosses", description=__doc__)
    parser.add_argument("folder", type=Path, help=f"holds {data.FILE}")
    parser.add_argument("--budget", type=int, default=160, help="evaluations a fit")
    parser.add_argument("--every", type=int, default=1, help="fit on every n-th toss of the half")
    parser.add_argument("--seed", type=int, default=1, help="of the searches")
    parser.add_argument("--engines", nargs="+", default=list(processes.ENGINES), metavar="ENGINE",
                        help=", ".join(processes.ENGINES))  # fmt: skip
    parser.add_argument("--read", type=Path, help="numbers of an earlier run; simulates nothing")
    parser.add_argument("--json", type=Path, help="where to write the numbers")
    parser.add_argument("--page", type=Path, help="where to write the manual's page")
    arguments = parser.parse_args()
    if arguments.read:
        results = json.loads(arguments.read.read_text())
    else:
        try:
            tosses = data.load(arguments.folder)
        except (FileNotFoundError, ValueError) as error:
            sys.exit(f"real_tosses: {error}")
        started, absent = processes.present(arguments.folder, arguments.engines)
        results = compare.run(
            tosses, started, arguments.budget, arguments.every, arguments.seed
        ) | {"absent": absent}
    print(report.markdown(results))
    if arguments.json:
        arguments.json.write_text(json.dumps(results, indent=1))
    if arguments.page:
        report.write_page(results, arguments.page)


if __name__ == "__main__":
    main()
