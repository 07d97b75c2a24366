"""python -m tests.bench.tosses.engines NAME FOLDER: jobs are lines of JSON, answers too."""

from __future__ import annotations

import importlib
import json
import os
import sys
import time
from dataclasses import asdict
from pathlib import Path

from tests.bench.tosses import data, flight, measures


def answer_job(engine, tosses: list[data.Toss], job: dict) -> dict:
    """Return the errors of a job's tosses (or why one failed), CPU time [s], poses if asked for."""
    calibration = flight.Calibration(**job["calibration"])
    noise = flight.Noise(**job["noise"]) if "noise" in job else None
    errors, poses = [], []
    begun = time.process_time()
    for index in job["tosses"]:
        toss = tosses[index]
        start = flight.start(toss, calibration)
        if noise is not None:
            start = flight.disturbed(start, noise, toss.number)
        try:
            found = engine.simulate(start, job["values"], job["setting"])
        except Exception as error:
            errors.append(f"{type(error).__name__}: {error}")
            poses.append(None)
            continue
        found[:, :3, 3] *= calibration.scale
        errors.append(measures.toss_errors(found, toss.poses))
        poses.append(found[:, :3].round(7).tolist() if job.get("poses") else None)
    return {"errors": errors, "cpu": time.process_time() - begun, "poses": poses}


def main(name: str, folder: str) -> None:
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what engines print is no answer

    def answer(what: dict) -> None:
        answers.write(json.dumps(what) + "\n")
        answers.flush()

    engine = importlib.import_module(f"tests.bench.tosses.engines.{name}")
    tosses = data.load(Path(folder))
    answer(
        {
            "name": engine.NAME,
            "version": engine.VERSION,
            "settings": engine.SETTINGS,
            "parameters": [asdict(parameter) for parameter in engine.PARAMETERS],
        }
    )
    for line in sys.stdin:
        answer(answer_job(engine, tosses, json.loads(line)))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
