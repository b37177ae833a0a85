"""The one exception of the package."""

from __future__ import annotations


class Error(Exception):
    """What is wrong, where, and what to do.

    position: a file, file:line:column, key of a scene or argument. finding: what is wrong there.
    remedy: what is allowed or helps; may be empty. status: the exit status that the program would
    end with (docs/ci.md): 2 usage, 3 input, 4 output, 5 a limit, 70 a bug.
    """

    def __init__(self, position: str, finding: str, remedy: str = "", status: int = 2) -> None:
        super().__init__(position, finding, remedy, status)
        self.position = position
        self.finding = finding
        self.remedy = remedy
        self.status = status

    def __str__(self) -> str:
        text = f"{self.position}: {self.finding}" if self.position else self.finding
        return f"{text}\n  allowed: {self.remedy}" if self.remedy else text
