"""How calls run, and how those that take long show their progress."""

from __future__ import annotations

import logging
import sys
import time
import warnings
from typing import Any, Callable, Union

# True: a bar; False: nothing; "auto": a bar in a terminal and in a notebook, of work that takes longer than a second; or a function that
# is called with the stage and its share done, 0…1, or None where that is not known. What it raises stops the work.
Progress = Union[bool, str, Callable[[str, "float | None"], object]]

log = logging.getLogger("belvedere")


class Display:
    """Remarks go to the logger; stages to a function, or to a bar of tqdm if it is installed, else to a line of text."""

    def __init__(self, call: Callable[[str, float | None], object] | None = None, bar_from_s: float | None = None) -> None:
        self._call = call
        self._bar_from_s = bar_from_s
        self._stage = ""
        self._bar: Any = None

    def note(self, text: str) -> None:
        log.info("%s", text)

    def update(self, stage: str, done: float, total: float) -> None:
        share = min(1.0, done / total) if total > 0 else None
        if stage and self._call is not None:
            self._call(stage, share)
        if stage and self._bar_from_s is not None and time.monotonic() > self._bar_from_s:
            self._show(stage, share)

    def _show(self, stage: str, share: float | None) -> None:
        try:
            with warnings.catch_warnings():  # without ipywidgets a notebook gets bars of text, and a warning that looks like a fault
                warnings.simplefilter("ignore")
                from tqdm.auto import tqdm
        except ImportError:
            self._stage = stage
            print(f"\r\033[K{stage}" + ("" if share is None else f" {share:4.0%}"), end="", file=sys.stderr, flush=True)
            return
        if stage != self._stage:
            self.close()
            form = "{desc} {elapsed}" if share is None else "{desc} {percentage:3.0f} %|{bar}| {elapsed}"
            self._stage, self._bar = stage, tqdm(desc=stage, total=None if share is None else 1.0, leave=False, bar_format=form)
        self._bar.n = share or 0
        self._bar.refresh()

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._stage:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
        self._stage, self._bar = "", None


def display(progress: Progress) -> Display:
    if callable(progress):
        return Display(progress)
    if progress == "auto":
        seen = "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty())
        return Display(bar_from_s=time.monotonic() + 1.0 if seen else None)
    return Display(bar_from_s=0.0 if progress else None)


def run(progress: Progress, threads: int = 0, memory_mib: int = 0, cache: bool = True) -> tuple:
    """How a call runs, for the module _belvedere."""
    return display(progress), threads, memory_mib, cache
