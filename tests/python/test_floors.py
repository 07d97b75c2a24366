"""The house rules that a machine can hold: floors, lengths, no macros, no forgotten file."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from tests.conftest import slow_cases

ROOT = Path(__file__).parents[2]
INCLUDE = ROOT / "cpp" / "include" / "saltus"
SRC = ROOT / "cpp" / "src"

# What each floor may include besides itself. error.hpp and the generated export.hpp are the ground.
GROUND = {"error", "export"}
FLOORS: dict[str, set[str]] = {"error": {"export"}, "export": set()}
FLOORS["spatial"] = set(GROUND)
FLOORS["tree"] = GROUND | {"spatial"}
for floor in ("lagrangian", "collision", "force", "constraint"):
    FLOORS[floor] = GROUND | {"spatial", "tree"}
FLOORS["model"] = FLOORS["tree"] | {"tree", "lagrangian", "collision", "force", "constraint"}
FLOORS["variational"] = FLOORS["model"] | {"model"}
FLOORS["derivatives"] = FLOORS["variational"] | {"variational"}
FLOORS["rollout"] = FLOORS["derivatives"] | {"derivatives"}
FLOORS["urdf"] = FLOORS["model"] | {"model"}
FLOORS["saltus"] = set(FLOORS)  # the umbrella header

# Rooms of a floor: a file includes its own room and those before it. Headers that users include
# have no folders; here is whose they are.
ROOMS: dict[str, dict[str, set[str]]] = {
    "collision": {
        "shapes": {"shapes", "hull"},
        "gap": {"gap", "gap_motion", "pair"},
        "convex": set(),
        "pairs": set(),
        "parts": {"parts"},
        "contact": {"contact", "slip"},
        "watch": {"ball_tree", "broad_phase", "pair_table"},
        "chord": {"chord"},
    },
    "variational": {
        "terms": {"energies", "impact_problem", "options", "report", "tape"},
        "law": {"cascade", "friction"},
        "uniqueness": {"certificate", "outcomes"},
        "overlap": {"overlap"},
        "node": set(),
        "arc": set(),
        "impact": set(),
        "flight": set(),
        "step": {"stepper"},
    },
}

INCLUDE_LINE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
MAX_FILE_LINES = 300
MAX_FUNCTION_LINES = 60


def files(*patterns: str) -> list[Path]:
    """Return the project's own files that match, without generated ones."""
    found = {path for pattern in patterns for path in ROOT.glob(pattern)}
    return sorted(path for path in found if path.name != "_core.pyi")


CPP_FILES = files(
    *(
        f"{folder}/**/*.{suffix}"
        for folder in ("cpp", "python/bindings", "tests", "examples")
        for suffix in ("hpp", "cpp")
    )
)
PYTHON_FILES = files("cpp/**/*.py", "python/**/*.py", "tests/**/*.py", "examples/**/*.py")
CMAKE_FILES = files(
    "CMakeLists.txt", "cpp/**/*.cmake", "tests/**/*.cmake", "tests/**/CMakeLists.txt"
)


def relative(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def floor_of(path: Path) -> str:
    """Return the floor of a file of the library: its folder, or its name if it is in none."""
    base = INCLUDE if path.is_relative_to(INCLUDE) else SRC
    return path.relative_to(base).parts[0].removesuffix(".hpp").removesuffix(".cpp")


def room_of(path: Path) -> str | None:
    """Return the room of a file of a floor that has rooms, None where it is in none."""
    rooms = ROOMS[floor_of(path)]
    if path.is_relative_to(INCLUDE):
        return next((room for room, headers in rooms.items() if path.stem in headers), None)
    return room if (room := path.relative_to(SRC).parts[1]) in rooms else None


def included_file(path: Path, name: str) -> Path | None:
    """Return the file of ours that an include names, None if it is somebody else's."""
    if name.startswith("saltus/"):
        return INCLUDE / name.removeprefix("saltus/")
    candidates = (path.parent / name, SRC / name)
    return next((each.resolve() for each in candidates if each.exists()), None)


def included_floor(path: Path, name: str) -> str | None:
    """Return the floor that an include of ours names, None if it is somebody else's."""
    included = included_file(path, name)
    return None if included is None else floor_of(included)


def blank_comments_and_strings(text: str) -> str:
    """Return C++ text with spaces in place of comments, literals and directives."""
    token = re.compile(
        r'R"([^(\s]*)\(.*?\)\1"|//(?:\\\n|[^\n])*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"'
        r"|(?<![0-9a-zA-Z_])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:\\\n|[^\n])*",
        re.DOTALL | re.MULTILINE,
    )
    return token.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def cpp_functions(text: str) -> list[tuple[int, int]]:
    """Return (first line, number of lines) of every function in C++ text, found by matching braces.

    A brace opens a scope if the words before it declare one, a function if they hold a parenthesis,
    and else an initialiser. The braces inside a function count as its own.
    """
    text = blank_comments_and_strings(text)
    found: list[tuple[int, int]] = []
    scopes: list[bool] = []  # for every open brace: is it a namespace or class?
    head_start, function_depth, first = 0, None, 0
    for match in re.finditer(r"[{};]", text):
        at, char = match.start(), match.group()
        if char == "{":
            head = text[head_start:at]
            is_scope = bool(
                re.search(r"\b(namespace|class|struct|union|enum|extern)\b[^()=]*$", head)
            )
            if function_depth is None and not is_scope and "(" in head:
                function_depth = len(scopes)
                first = head_start + len(head) - len(head.lstrip())
            scopes.append(is_scope)
        elif char == "}" and scopes:
            scopes.pop()
            if function_depth == len(scopes):
                if re.match(r"\s*[,{]", text[at + 1 :]):  # a constructor's `: a{1}, b{2} {`
                    function_depth = None
                    continue
                start = text.count("\n", 0, first) + 1
                found.append((start, text.count("\n", 0, at) + 2 - start))
                function_depth = None
        if function_depth is None:
            head_start = at + 1
    return found


def python_functions(text: str) -> list[tuple[int, int]]:
    """Return (first line, lines without the docstring) of every function in Python text."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            lines = node.end_lineno - node.lineno + 1
            if ast.get_docstring(node) is not None:
                lines -= node.body[0].end_lineno - node.body[0].lineno + 1
            found.append((node.lineno, lines))
    return found


def test_includes_never_point_up():
    wrong = []
    for path in (p for p in CPP_FILES if p.is_relative_to(INCLUDE) or p.is_relative_to(SRC)):
        own = floor_of(path)
        if own not in FLOORS:
            wrong.append(f"{relative(path)}: unknown floor {own!r}; floors are {', '.join(FLOORS)}")
            continue
        for name in INCLUDE_LINE.findall(path.read_text()):
            other = included_floor(path, name)
            if other is not None and other != own and other not in FLOORS[own]:
                wrong.append(f"{relative(path)}: floor {own!r} must not include {name}")
    assert not wrong, "\n".join(wrong)


def test_includes_stay_in_rooms_or_go_down():
    wrong = []
    in_rooms = (p for p in CPP_FILES if p.is_relative_to(INCLUDE) or p.is_relative_to(SRC))
    for path in (p for p in in_rooms if floor_of(p) in ROOMS):
        floor, own = floor_of(path), room_of(path)
        order = list(ROOMS[floor])
        if own is None:
            wrong.append(f"{relative(path)} is in no room; rooms are {', '.join(order)}")
            continue
        for name in INCLUDE_LINE.findall(path.read_text()):
            included = included_file(path, name)
            if included is None or floor_of(included) != floor:
                continue
            other = room_of(included)
            if other is None or order.index(other) > order.index(own):
                wrong.append(f"{relative(path)}: room {own!r} must not include {name} of {other!r}")
    assert not wrong, "\n".join(wrong)


def test_files_are_short():
    long = []
    for path in [*CPP_FILES, *PYTHON_FILES, *CMAKE_FILES]:
        lines = len(path.read_text().splitlines())
        if lines > MAX_FILE_LINES:
            long.append(f"{relative(path)}: {lines} > {MAX_FILE_LINES} lines")
    assert not long, "\n".join(long)


def test_functions_are_short():
    long = []
    finders = [(path, cpp_functions) for path in CPP_FILES]
    finders += [(path, python_functions) for path in PYTHON_FILES]
    for path, find in finders:
        for first, lines in find(path.read_text()):
            if lines > MAX_FUNCTION_LINES:
                long.append(f"{relative(path)}:{first}: {lines} > {MAX_FUNCTION_LINES} lines")
    assert not long, "\n".join(long)


def test_no_function_like_macros():
    macros = []
    for path in CPP_FILES:
        names = re.findall(r"^\s*#\s*define\s+(\w+)\(", path.read_text(), re.MULTILINE)
        macros += [f"{relative(path)}: {name}" for name in names]
    assert not macros, "\n".join(macros)


@pytest.mark.parametrize(
    ("listing", "base", "folders"),
    [
        ("cpp/sources.cmake", ".", ["cpp/src", "python/bindings"]),
        ("tests/cpp/tests.cmake", "tests/cpp", ["tests/cpp"]),
    ],
)
def test_every_source_file_is_listed(listing, base, folders):
    code = re.sub(r"#.*", "", (ROOT / listing).read_text())
    listed = set(re.findall(r"[\w/.]+\.cpp", code))
    present = {
        path.relative_to(ROOT / base).as_posix()
        for folder in folders
        for path in (ROOT / folder).rglob("*.cpp")
    }
    assert not listed - present, f"{listing} lists files that do not exist"
    assert not present - listed, f"append these to {listing}"


def test_slow_cpp_tests_exist():
    sources = "".join(path.read_text() for path in (ROOT / "tests" / "cpp").rglob("test_*.cpp"))
    cases = {".".join(x) for x in re.findall(r"TEST\w*\(\s*(\w+),\s*(\w+)\)", sources)}
    assert slow_cases()
    assert not slow_cases() - cases, "tests/cpp/slow.txt names tests that do not exist"


def test_cpp_functions_are_found():
    text = """
    namespace a {
    struct S {
      int x = 0;
      S() : x{1}, y{2} {
        f("}");  // }
      }
      std::vector<int> y = {1, 2};
    };
    constexpr S table[] = {{1}, {2}};
    template <class T> auto g(T t) -> decltype(t) {
      auto h = [](int) { return R"x({)x"; };
      if (t) { return '{'; }
    }
    enum class E { kA };
    }
    """
    assert cpp_functions(text) == [(5, 3), (11, 4)]
