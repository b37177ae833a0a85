"""How long calls show their progress."""

from __future__ import annotations

import logging
import sys
import time
from typing import Callable, Union

# True: a bar; False: nothing; "auto": a bar in a terminal and in a notebook, of work that takes longer
# than a second; or a function that is called with the stage and its share done, 0…1, or None where that
# is not known. What it raises stops the work.
Progress = Union[bool, str, Callable[[str, "float | None"], object]]

log = logging.getLogger("belvedere")
wait_s = 1.0


class Display:
    """Shows nothing. Remarks go to the logger "belvedere"."""

    def update(self, stage: str, done: float, total: float) -> None:
        pass

    def note(self, text: str) -> None:
        log.info("%s", text)

    def close(self) -> None:
        pass


class Called(Display):
    def __init__(self, call: Callable[[str, float | None], object]) -> None:
        self._call = call

    def update(self, stage: str, done: float, total: float) -> None:
        if stage:
            self._call(stage, min(1.0, done / total) if total > 0 else None)


class Bar(Display):
    """A bar for each stage: of tqdm if it is installed, else a line of text."""

    def __init__(self, after_s: float) -> None:
        self._from = time.monotonic() + after_s
        self._stage = ""
        self._bar = None

    def update(self, stage: str, done: float, total: float) -> None:
        if not stage or time.monotonic() < self._from:
            return
        if stage != self._stage:
            self.close()
            self._stage = stage
            self._bar = _new_bar(stage, total)
        self._bar.n = min(done, total or done)
        self._bar.refresh()

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        self._bar = None
        self._stage = ""


class TextBar:
    """What Bar needs of tqdm."""

    def __init__(self, desc: str, total: float | None) -> None:
        self.n = 0.0
        self._desc = desc
        self._total = total

    def refresh(self) -> None:
        share = f" {100 * min(1.0, self.n / self._total):3.0f} %" if self._total else ""
        print(f"\r\033[K{self._desc}{share}", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print("\r\033[K", end="", file=sys.stderr, flush=True)


def _new_bar(stage: str, total: float):
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return TextBar(stage, total or None)
    form = "{desc} {percentage:3.0f} %|{bar}| {elapsed}" if total > 0 else "{desc} {elapsed}"
    return tqdm(desc=stage, total=total or None, leave=False, bar_format=form)


def _is_seen() -> bool:
    if "ipykernel" in sys.modules:
        return True
    return sys.stderr is not None and sys.stderr.isatty()


def display(progress: Progress) -> Display:
    if callable(progress):
        return Called(progress)
    if progress == "auto":
        return Bar(wait_s) if _is_seen() else Display()
    return Bar(0.0) if progress else Display()


def run(progress: Progress, threads: int = 0, memory_mib: int = 0, cache: bool = True) -> tuple:
    """How a call runs, for the module _belvedere."""
    return display(progress), threads, memory_mib, cache
