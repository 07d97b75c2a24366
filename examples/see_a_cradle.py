"""A page that plays a Newton's cradle: open cradle.html in a browser.

The first ball is let go at 0.3 rad. It meets the others after a quarter of its period, at
sqrt(I/g) K(sin 0.15) = 0.50460 s with I = 1.001 kg m^2 about the pivot, and then an impact follows
each half of a period, 1.00921 s: nine more within 10 s.
"""

import json
import re
from pathlib import Path

import saltus

model = saltus.load_urdf(Path(__file__).parents[1] / "urdf" / "newtons_cradle_3.urdf")
run = saltus.simulate(model, q={"swing_0": 0.3}, duration=10.0, h=0.001)
page = run.html("cradle.html", dark=False)

# What the page will show is in it as JSON.
stored = re.search(r'<script type="application/json" id="saltus-data">(.*?)</script>', page)
scene = json.loads(stored.group(1))
print(f"{len(scene['bodies'])} bodies, in a file of {len(page) // 10**5 / 10} MB")
print(f"first impact at {run.impacts['t'][0]:.5f} s, {scene['impacts']['t']['shape'][0]} in all")
