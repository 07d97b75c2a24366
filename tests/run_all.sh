#!/bin/sh
# Sets everything up, then runs the C++ and the Python tests; arguments go to pytest (for instance: -k impact).
set -eu
cd "$(dirname "$0")/.."
sh examples/setup.sh
exec .venv/bin/python -m pytest "$@"
