"""Finding the program and running it: its progress, notes and errors go to the feedback, and when
the feedback is cancelled the program is ended."""
import json
import os
import re
import select
import shlex
import shutil
import subprocess
from typing import Any, List, Optional

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import QgsProcessingException, QgsProcessingFeedback

try:
    import pty
except ImportError:  # Windows, for which there is no program
    pty = None

SETTING = "BELVEDERE_PROGRAM"
INSTALL = (
    "The program belvedere was not found. Install it (on Debian 12: tools/package, then apt-get "
    "install ./build/release/belvedere_*.deb; see docs/installing.md), or name it in Settings > "
    "Options > Processing > Providers > Belvedere, or in the environment variable "
    "BELVEDERE_PROGRAM.")
GRACE_S = 0.7  # in which the program may remove its unfinished files before it is killed
# They name files of the QGIS that runs this; another program has its own.
FOREIGN_VARIABLES = ("GDAL_DATA", "GDAL_DRIVER_PATH", "PROJ_LIB", "PROJ_DATA", "PYTHONHOME")

_stage = re.compile(r"(?P<stage>.+?) (?:…$|[█░]+ +(?P<percent>\d+) %)")


def find() -> Optional[str]:
    """Path of the program: by the setting, the environment or the PATH; None if there is none."""
    named = ProcessingConfig.getSetting(SETTING) or os.environ.get(SETTING)
    return shutil.which(named or "belvedere") if pty else None


class _Listener:
    """Lines of the program's error stream: the bar of a stage, finished stages, notes, errors."""

    def __init__(self, feedback: QgsProcessingFeedback):
        self.feedback = feedback
        self.errors: List[str] = []
        self._rest, self._stage = b"", ""

    def feed(self, data: bytes) -> None:
        *lines, self._rest = re.split(rb"[\r\n]+", self._rest + data)
        for line in lines:
            self._line(line.decode("utf-8", "replace").replace("\033[K", "").rstrip())
        # The bar's line has no end as long as it is drawn again.
        self._progress(self._rest.decode("utf-8", "ignore").replace("\033[K", ""))

    def _progress(self, line: str) -> bool:
        found = _stage.match(line)
        if found and found["stage"] != self._stage:
            self._stage = found["stage"]
            self.feedback.setProgressText(self._stage)
        if found and found["percent"]:
            self.feedback.setProgress(float(found["percent"]))
        return bool(found)

    def _line(self, line: str) -> None:
        if not line or self._progress(line):
            return
        if line.startswith("belvedere: ") or self.errors:  # further lines tell what is allowed
            self.errors.append(line[len("belvedere: "):] if not self.errors else line)
        else:
            self.feedback.pushInfo(line)


def _end(process: subprocess.Popen) -> None:
    process.terminate()
    try:
        process.wait(GRACE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def run(arguments: List[str], feedback: QgsProcessingFeedback) -> str:
    """Runs the program with these arguments and returns its standard output. Throws
    QgsProcessingException with the program's own words if it fails, or if it was cancelled."""
    path = find()
    if path is None:
        raise QgsProcessingException(INSTALL)
    feedback.pushCommandInfo(" ".join(shlex.quote(word) for word in ["belvedere", *arguments]))
    environment = {k: v for k, v in os.environ.items() if k not in FOREIGN_VARIABLES}
    # Only on a terminal does the program tell the share of a stage that is done.
    terminal, errors = pty.openpty()
    process = subprocess.Popen([path, *arguments], stdin=subprocess.DEVNULL, env=environment,
                               stdout=subprocess.PIPE, stderr=errors)
    os.close(errors)
    output, listener, streams = b"", _Listener(feedback), [process.stdout.fileno(), terminal]
    try:
        while streams:
            if feedback.isCanceled():
                raise QgsProcessingException("Stopped: the program was ended by request.")
            for stream in select.select(streams, [], [], 0.05)[0]:
                try:
                    data = os.read(stream, 65536)
                except OSError:  # how a terminal ends
                    data = b""
                if not data:
                    streams.remove(stream)
                elif stream == terminal:
                    listener.feed(data)
                else:
                    output += data
        listener.feed(b"\n")
        status = process.wait()
    finally:
        if process.poll() is None:
            _end(process)
        process.stdout.close()
        os.close(terminal)
    if status != 0:
        text = "\n".join(listener.errors) or "The program gave no reason."
        raise QgsProcessingException(f"{text}\n(belvedere ended with status {status})")
    return output.decode("utf-8")


def ask(arguments: List[str], feedback: QgsProcessingFeedback) -> Any:
    """Runs the program with --json and returns its answer."""
    return json.loads(run([*arguments, "--json"], feedback))
