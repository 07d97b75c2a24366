"""Make every GoogleTest case a pytest item, built against the installed package.

So one `pytest` runs everything and closes with one count, and every run proves that
find_package(saltus) works.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import hypothesis
import pytest

ROOT = Path(__file__).parent.parent
BUILD = ROOT / "build" / "tests"
PROGRAM_TIMEOUT = 900  # s; a hanging case must not hang the run
SLOW = ROOT / "tests" / "cpp" / "slow.txt"
RESULT = re.compile(r"\[ +(RUN|OK|FAILED|SKIPPED) +\] ([\w./]+)")

# Deadlines measure the machine; derandomised cases make a red CI repeatable.
hypothesis.settings.register_profile(
    "saltus", deadline=None, derandomize="CI" in os.environ, print_blob=True
)
hypothesis.settings.load_profile("saltus")

# A shell that runs us in the background has us ignore SIGINT, and so would the programs that tests
# of Ctrl-C start: whoever handles a signal starts programs with its default.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def tool(name: str) -> str | None:
    """Return the environment's own program (pip install cmake ninja) or the one on PATH."""
    own = Path(sys.executable).parent / name
    return str(own) if own.exists() else shutil.which(name)


def package_prefix() -> Path:
    """Return the CMake prefix of the installed package (never the source tree's python/saltus)."""
    import saltus._core

    return Path(saltus._core.__file__).resolve().parent


def cmake(*arguments: object) -> str:
    """Run CMake and return what it printed; raise CalledProcessError with that as stdout."""
    program = tool("cmake")
    if program is None:
        raise RuntimeError("cmake is missing: pip install cmake ninja")
    command = [program, *map(str, arguments)]
    stdout, stderr = subprocess.PIPE, subprocess.STDOUT
    return subprocess.run(command, check=True, stdout=stdout, stderr=stderr, text=True).stdout


def configure(source: Path, build: Path, prefix: str, *arguments: str) -> str:
    """Configure a CMake project with Ninja if there is one."""
    ninja = tool("ninja")
    generator = ["-GNinja", f"-DCMAKE_MAKE_PROGRAM={ninja}"] if ninja else []
    prefixes = f"-DCMAKE_PREFIX_PATH={prefix}"
    return cmake("-S", source, "-B", build, *generator, prefixes, *arguments)


def keep_times_of_unchanged_files(prefix: Path) -> None:
    """Give files that pip wrote anew, but unchanged, their old times.

    Else every edit of one source would recompile all C++ tests.
    """
    record_file = BUILD / "installed.json"
    known = json.loads(record_file.read_text()) if record_file.exists() else {}
    record = {}
    for path in sorted(p for p in prefix.rglob("*") if p.suffix in {".hpp", ".cmake"}):
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        before = known.get(str(path), {})
        if before.get("digest") == digest:
            os.utime(path, ns=(before["time"], before["time"]))
        record[str(path)] = {"digest": digest, "time": path.stat().st_mtime_ns}
    BUILD.mkdir(parents=True, exist_ok=True)
    record_file.write_text(json.dumps(record))


def build_cpp_tests() -> Path:
    """Build the C++ tests against the installed package and return the folder of the programs."""
    prefix = package_prefix()
    keep_times_of_unchanged_files(prefix)
    configure(
        ROOT / "tests" / "cpp",
        BUILD,
        f"{prefix};{sys.prefix}",
        "-DCMAKE_BUILD_TYPE=Release",
        f"-DSALTUS_WERROR={os.environ.get('SALTUS_WERROR', 'OFF')}",
    )
    cmake("--build", BUILD)
    return BUILD


def list_cases(program: Path) -> list[str]:
    """Return the names of a GoogleTest program's cases, as Suite.Case."""
    listing = subprocess.run(
        [program, "--gtest_list_tests"], check=True, capture_output=True, text=True
    ).stdout
    cases, suite = [], ""
    for line in listing.splitlines():
        name = line.split("#")[0].rstrip()  # after # stands the value of a parameter
        if line.startswith("  "):
            cases.append(suite + name.strip())
        elif name.endswith("."):
            suite = name
    return cases


def slow_cases() -> set[str]:
    """Return the C++ cases that are marked `slow`, as Suite.Case."""
    lines = SLOW.read_text(encoding="utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def plain_name(case: str) -> str:
    """Return the name of a case without its instantiation and its parameter."""
    return re.sub(r"^\w+/(?=.*\.)|/\w+$", "", case)


def parse_output(text: str) -> tuple[dict[str, tuple[str, str]], str | None]:
    """Return {case: (OK | FAILED | SKIPPED, text)} and the case that did not end, if any."""
    results: dict[str, tuple[str, str]] = {}
    running, begin = None, 0
    for match in RESULT.finditer(text):
        word, name = match.groups()
        if word == "RUN":
            running, begin = name, match.start()
        elif name == running:  # the summary at the end repeats names; nothing runs then
            end = text.find("\n", match.end())
            results[name] = (word, text[begin : end if end >= 0 else len(text)])
            running = None
    if running is not None:
        results[running] = ("FAILED", text[begin:])
    return results, running


class CppProgram(pytest.File):
    """One GoogleTest program, run once for all its selected cases.

    A process for each of hundreds of cases would cost seconds.
    """

    def __init__(self, *, program: Path, **kwargs: object) -> None:
        super().__init__(**kwargs)
        self.program = program
        self.results: dict[str, tuple[str, str]] = {}

    def collect(self):
        slow = slow_cases()
        for case in list_cases(self.program):
            item = CppCase.from_parent(self, name=case)
            if plain_name(case) in slow:
                item.add_marker(pytest.mark.slow)
            yield item

    def run_selected(self) -> None:
        selected = [item.name for item in self.session.items if item.parent is self]
        while selected:
            output, ended = self._run(selected)
            results, crashed = parse_output(output)
            if crashed is not None:
                text = f"{results[crashed][1]}\n{self.program.name} {ended}"
                results[crashed] = ("FAILED", text)
            self.results.update(results)
            rest = [name for name in selected if name not in self.results]
            if crashed is None or len(rest) == len(selected):
                missing = ("FAILED", f"{self.program.name} {ended}, without this case:\n{output}")
                self.results.update(dict.fromkeys(rest, missing))
                return
            selected = rest  # a crash takes the cases after it along: run them without it

    def _run(self, cases: list[str]) -> tuple[str, str]:
        # A file of flags, because hundreds of names are too long for one argument.
        flags = self.program.with_suffix(".flags")
        flags.write_text(f"--gtest_color=no\n--gtest_filter={':'.join(cases)}\n")
        command = [self.program, f"--gtest_flagfile={flags}"]
        try:
            done = subprocess.run(
                command,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                timeout=PROGRAM_TIMEOUT,
            )
        except subprocess.TimeoutExpired as error:
            return (error.stdout or b"").decode(errors="replace"), "was stopped: timeout"
        code = done.returncode
        ended = f"died of signal {-code}" if code < 0 else f"ended with code {code}"
        return done.stdout.decode(errors="replace"), ended


class CppFailure(Exception):
    """Carries the output of a failed GoogleTest case."""


class CppCase(pytest.Item):
    """One GoogleTest case."""

    def runtest(self) -> None:
        if self.name not in self.parent.results:
            self.parent.run_selected()
        outcome, text = self.parent.results[self.name]
        if outcome == "SKIPPED":
            pytest.skip(text)
        if outcome == "FAILED":
            raise CppFailure(text)

    def repr_failure(self, excinfo, style=None):
        if isinstance(excinfo.value, CppFailure):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self):
        return self.path, None, f"{self.parent.program.name}::{self.name}"


class CppTests(pytest.File):
    """The project tests/cpp."""

    def collect(self):
        try:
            build = build_cpp_tests()
        except subprocess.CalledProcessError as error:
            raise self.CollectError(f"C++ tests did not build:\n{error.stdout[-8000:]}") from None
        for program in sorted(p for p in build.glob("test_*") if not p.suffix and p.is_file()):
            yield CppProgram.from_parent(
                self, path=self.path, nodeid=f"tests/cpp/{program.name}", program=program
            )


def pytest_collect_file(file_path: Path, parent: pytest.Collector):
    if file_path == ROOT / "tests" / "cpp" / "CMakeLists.txt":
        return CppTests.from_parent(parent, path=file_path)
    return None
