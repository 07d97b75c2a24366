"""python -m compare.engines NAME: scenes come in as lines of JSON, what was measured goes out."""

from __future__ import annotations

import importlib
import json
import os
import sys
import time

from compare.measure import measures
from compare.scene import Scene, record


def main(name: str) -> None:
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what engines print is no answer

    def answer(data: dict) -> None:
        answers.write(json.dumps(data) + "\n")
        answers.flush()

    engine = importlib.import_module(f"compare.engines.{name}")
    answer({"name": engine.NAME, "version": engine.VERSION, "setting": engine.SETTING})
    for line in sys.stdin:
        scene = Scene(**json.loads(line))
        simulation = engine.load(scene)
        start = time.process_time()
        rows = record(simulation, scene)
        cpu = time.process_time() - start
        answer(measures(scene, rows) | {"cpu": cpu})


if __name__ == "__main__":
    main(sys.argv[1])
