"""The progress of a run: a bar, or a function of the caller."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext

Progress = Callable[[float], object]

# Runs that end sooner need no bar.
BAR_DELAY = 2.0  # [s]
BAR_FORMAT = "{l_bar}{bar}| {n:.2f}/{total:.2f} {unit} [{elapsed}<{remaining}]"


def progress_bar(
    progress: bool | Progress | None, total: float, unit: str
) -> AbstractContextManager[Progress | None]:
    """Give, within `with`, the function that takes the completed fraction."""
    if progress is False:
        return nullcontext()
    if callable(progress):
        return nullcontext(progress)
    try:
        total = float(total)
    except (TypeError, ValueError, OverflowError):
        return nullcontext()  # what takes it as its duration says what is wrong
    return Bar(total, unit, always=progress is True)


class Bar:
    """A bar on stderr; a class, as `contextlib.contextmanager` writes to exceptions it lets out."""

    def __init__(self, total: float, unit: str, *, always: bool) -> None:
        from tqdm import tqdm  # here: it takes a fifth of the time of `import saltus`

        self.total = total
        self.bar = tqdm(
            total=total,
            unit=unit,
            bar_format=BAR_FORMAT,
            delay=0.0 if always else BAR_DELAY,
            disable=False if always else None,  # None: only where stderr is a terminal
            leave=always,
        )

    def __enter__(self) -> Progress:
        return lambda part: self.bar.update(part * self.total - self.bar.n)

    def __exit__(self, *_: object) -> None:
        self.bar.close()
