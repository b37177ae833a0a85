"""Finding the program and running it: its progress, notes and errors go to the feedback, and when
the feedback is cancelled the program is ended."""
import json
import os
import queue
import re
import shlex
import shutil
import subprocess
import threading
from typing import Any, List, Optional

from qgis.core import QgsProcessingException, QgsProcessingFeedback

try:  # only with a terminal does the program report shares of a stage; Windows has none
    import pty
except ImportError:
    pty = None

SETTING = "BELVEDERE_PROGRAM"
INSTALL = (
    "The program belvedere was not found. Install it (on Debian 12: tools/package, then "
    "apt-get install ./build/release/belvedere_*.deb; see docs/installing.md), or name it in "
    "Settings > Options > Processing > Providers > Belvedere, or in the environment variable "
    "BELVEDERE_PROGRAM."
)
# Seconds in which the program may remove its unfinished files before it is killed.
GRACE_S = 0.7
# Files of the QGIS that runs this: another program has its own.
FOREIGN_VARIABLES = ("GDAL_DATA", "GDAL_DRIVER_PATH", "PROJ_LIB", "PROJ_DATA", "PYTHONHOME")

_bar = re.compile(r"(?P<stage>.+?) [█░]+ +(?P<percent>\d+) %")
_waiting = re.compile(r"(?P<stage>.+) …$")


def _setting() -> str:
    try:
        from processing.core.ProcessingConfig import ProcessingConfig
    except ImportError:
        return ""
    return ProcessingConfig.getSetting(SETTING) or ""


def find() -> Optional[str]:
    """Path of the program: by the setting, the environment or the PATH; None if there is none."""
    named = _setting() or os.environ.get(SETTING, "")
    return shutil.which(named or "belvedere")


class _Listener:
    """Lines of the program's error stream: the bar of a stage, finished stages, notes, errors."""

    def __init__(self, feedback: QgsProcessingFeedback):
        self.feedback = feedback
        self.errors: List[str] = []
        self._rest = b""
        self._stage = ""

    def feed(self, data: bytes) -> None:
        *lines, self._rest = re.split(rb"[\r\n]+", self._rest + data)
        for line in lines:
            self._line(line.decode("utf-8", "replace").replace("\033[K", "").rstrip())
        # A bar has no end of line as long as it is drawn again.
        self._progress(self._rest.decode("utf-8", "ignore").replace("\033[K", ""))

    def end(self) -> None:
        self.feed(b"\n")

    def _progress(self, line: str) -> bool:
        bar = _bar.match(line)
        stage = bar or _waiting.match(line)
        if not stage:
            return False
        if stage["stage"] != self._stage:
            self._stage = stage["stage"]
            self.feedback.setProgressText(self._stage)
        if bar:
            self.feedback.setProgress(float(bar["percent"]))
        return True

    def _line(self, line: str) -> None:
        if not line or self._progress(line):
            return
        if line.startswith("belvedere: "):
            self.errors.append(line[len("belvedere: ") :])
        elif self.errors:  # an error's further lines: what is allowed
            self.errors.append(line)
        else:
            self.feedback.pushInfo(line)


def _end(process: subprocess.Popen) -> None:
    """Asks the program to stop, and kills it if it does not within the time of grace."""
    process.terminate()
    try:
        process.wait(GRACE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _read(descriptor: int, name: str, lines: "queue.Queue") -> None:
    """Passes on what a stream says, and at its end nothing: a thread for each stream."""
    while True:
        try:
            data = os.read(descriptor, 65536)
        except OSError:  # how a terminal ends
            data = b""
        lines.put((name, data))
        if not data:
            return


def run(arguments: List[str], feedback: QgsProcessingFeedback) -> str:
    """Runs the program with these arguments and returns its standard output. Throws
    QgsProcessingException with the program's own words if it fails, or if it was cancelled."""
    path = find()
    if path is None:
        raise QgsProcessingException(INSTALL)
    feedback.pushCommandInfo(" ".join(shlex.quote(word) for word in ["belvedere", *arguments]))
    environment = {k: v for k, v in os.environ.items() if k not in FOREIGN_VARIABLES}
    terminal, errors = pty.openpty() if pty else (None, subprocess.PIPE)
    process = subprocess.Popen(
        [path, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=errors,
        env=environment,
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    )
    if pty:
        os.close(errors)
    said, output, listener = queue.Queue(), [], _Listener(feedback)
    streams = {"out": process.stdout.fileno(), "err": terminal or process.stderr.fileno()}
    threads = [
        threading.Thread(target=_read, args=(descriptor, name, said), daemon=True)
        for name, descriptor in streams.items()
    ]
    for thread in threads:
        thread.start()
    try:
        while streams:
            if feedback.isCanceled():
                raise QgsProcessingException("Stopped: the program was ended by request.")
            try:
                name, data = said.get(timeout=0.05)
            except queue.Empty:
                continue
            if not data:
                del streams[name]
            elif name == "err":
                listener.feed(data)
            else:
                output.append(data)
        listener.end()
        status = process.wait()
    finally:
        if process.poll() is None:
            _end(process)
        for thread in threads:
            thread.join(GRACE_S)  # before what they read is closed
        process.stdout.close()
        if terminal is not None:
            os.close(terminal)
    if status != 0:
        text = "\n".join(listener.errors) or "The program gave no reason."
        raise QgsProcessingException(f"{text}\n(belvedere ended with status {status})")
    return b"".join(output).decode("utf-8")


def ask(arguments: List[str], feedback: QgsProcessingFeedback) -> Any:
    """Runs the program with --json and returns its answer."""
    return json.loads(run([*arguments, "--json"], feedback))
