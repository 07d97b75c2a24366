#!/bin/sh
# Sets everything up, the other engines too, and prints the benchmarks' table; arguments go to python -m tests.bench.
set -eu
cd "$(dirname "$0")/../.."
sh examples/setup.sh bench,robots
exec .venv/bin/python -m tests.bench "$@"
