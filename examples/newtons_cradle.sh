#!/bin/sh
# Sets everything up, simulates a Newton's cradle of three balls for 10 s, prints what happened and draws it.
set -eu
cd "$(dirname "$0")/.."
sh examples/setup.sh
exec .venv/bin/saltus simulate urdf/newtons_cradle_3.urdf --set swing_0=0.3 --duration 10 --h 0.01 \
  --plot newtons_cradle.png
