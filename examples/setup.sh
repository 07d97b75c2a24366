#!/bin/sh
# setup.sh [EXTRA...]: leaves .venv with this package, its test and demo packages, and those of the extras named now
# or earlier. Does nothing when the sources are those of the last time and no extra is new.
set -eu
cd "$(dirname "$0")/.."

# The stamp holds a checksum over contents, not times (a checkout of other branches and back rebuilds nothing), and the
# extras that are installed.
stamp=.venv/.saltus
sources="$(find CMakeLists.txt pyproject.toml cpp python/bindings python/saltus urdf examples/setup.sh \
  -type f ! -name '*.pyc' -exec cksum {} + | LC_ALL=C sort | cksum)"
extras="$(sed -n 2p "$stamp" 2>/dev/null || true)"
for extra in test "$@"; do
  case ",$extras," in *",$extra,"*) ;; *) extras="${extras:+$extras,}$extra" ;; esac
done
if [ -x .venv/bin/python ] && [ "$(cat "$stamp" 2>/dev/null)" = "$(printf '%s\n%s' "$sources" "$extras")" ]; then
  exit 0
fi

# True if there are a C++ compiler, and a Python that can make environments and has its headers.
machine_is_ready() {
  [ -n "${CXX:-}" ] || command -v c++ >/dev/null || command -v g++ >/dev/null || command -v clang++ >/dev/null || return 1
  python3 - 2>/dev/null <<'PY'
import ensurepip, pathlib, sys, sysconfig, venv
headers = pathlib.Path(sysconfig.get_paths()["include"], "Python.h")
sys.exit(0 if headers.exists() and sys.version_info >= (3, 10) else 1)
PY
}

if ! machine_is_ready; then
  packages="g++ python3-venv python3-dev ca-certificates"
  if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    echo "setup: apt-get installs $packages" >&2
    apt-get update -qq
    # shellcheck disable=SC2086  # several words are meant
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 $packages >/dev/null
  fi
  if ! machine_is_ready; then
    echo "setup: a C++ compiler or Python >= 3.10 with its headers is missing; on Debian and Ubuntu run first:" >&2
    echo "  sudo apt-get install $packages" >&2
    exit 1
  fi
fi

.venv/bin/python -c '' 2>/dev/null || python3 -m venv --clear .venv
pip() { .venv/bin/python -m pip --disable-pip-version-check -q "$@"; }

# The build's own packages go into .venv, and pip builds without isolation: an isolated build gets new paths each
# time, so that every edit would compile everything.
tools=""
command -v cmake >/dev/null && cmake -P cpp/cmake/check_version.cmake 2>/dev/null || tools="cmake"
command -v ninja >/dev/null || tools="$tools ninja"
echo "setup: installing into .venv and compiling; the first time takes a few minutes" >&2
.venv/bin/python cpp/cmake/build_requires.py >.venv/build-requires.txt
# shellcheck disable=SC2086  # several words are meant
pip install -r .venv/build-requires.txt $tools
# scikit-build-core imports packages that offer a CMake prefix, ours among them: a broken one could not be replaced.
printf 'unfinished\n%s\n' "$extras" >"$stamp"
pip uninstall -y saltus 2>/dev/null
pip install --no-build-isolation ".[$extras]"
printf '%s\n%s\n' "$sources" "$extras" >"$stamp"
