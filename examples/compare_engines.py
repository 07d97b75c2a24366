"""Touching balls in saltus, MuJoCo, DART, PyBullet and pymunk, in tables and in compare.png.

Of a cradle as many balls leave as came, and of three balls with masses 1, sqrt(2) - 1, 1 the first
returns with -0.172 and the others leave with 0.828. Engines that are not installed are left out:
pip install 'saltus[compare]'. Takes two minutes; --quick shows the first impacts only.
"""

import argparse
from pathlib import Path

from compare import picture, processes, report, scenes

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="2 s of cradles instead of 60 s")
parser.add_argument("--page", type=Path, help="write the manual's page here, with its picture")
arguments = parser.parse_args()

chosen = scenes.all_scenes(arguments.quick)
results, absent = processes.run_engines(chosen), processes.absent()
print(report.settings(results, absent) + "\n")
print(report.tables(chosen, results))
if arguments.page:
    report.write_page(arguments.page, chosen, results, absent)
else:
    picture.draw(chosen, results, Path("compare.png"))
