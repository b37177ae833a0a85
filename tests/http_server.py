#!/usr/bin/env python3
"""A server of files for tests, on a port of its own that it prints first. It answers one client after the other.

http_server.py FOLDER [fail=N] [after=M] [retry-after=S] [cut=N] [short=N] [stall] [stall-once] [no-ranges] [log=FILE]
  fail=N         N requests get the answer 503: the first, or those after M others
  retry-after=S  and are asked to wait S seconds
  cut=N          the connection ends in the middle of N answers: the first, or those after M others
  short=N        N answers have fewer bytes than were asked for, and say so: the first, or those after M others
  stall          requests for bytes get headers and then nothing
  stall-once     the first one does
  no-ranges      always the whole file, whatever part is asked for
  log=FILE       a line for each request: its method, path and range
Files that have a date beside them, NAME.tag, get that as their ETag.
"""
import http.server
import pathlib
import re
import sys
import time

folder = pathlib.Path(sys.argv[1])
modes = sys.argv[2:]


def value(mode):
    return next((m.partition("=")[2] for m in modes if m.startswith(mode + "=")), "")


def number(mode):
    return int(value(mode) or 0)


left = {mode: number(mode) for mode in ("fail", "cut", "short")}
left["stall"] = 10**9 if "stall" in modes else 1 if "stall-once" in modes else 0
good_before = number("after")
log = open(value("log"), "a", encoding="utf-8") if value("log") else None


def happens(fault):
    """Whether the fault is due now; each time that it is, one less is left."""
    if good_before >= 0 or left[fault] <= 0:
        return False
    left[fault] -= 1
    return True


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def refuse(self, status):
        self.send_response(status)
        if status == 503 and value("retry-after"):
            self.send_header("Retry-After", value("retry-after"))
        self.send_header("Content-Length", "0")
        self.end_headers()

    def answer(self, with_body):
        global good_before
        good_before -= 1
        if log:
            log.write(f"{self.command} {self.path} {self.headers.get('Range', '')} [{self.headers.get('User-Agent', '')}]\n")
            log.flush()
        if happens("fail"):
            return self.refuse(503)
        file = folder / self.path.lstrip("/").partition("?")[0]
        if not file.is_file():
            return self.refuse(404)
        data = file.read_bytes()
        part = re.match(r"bytes=(\d+)-(\d*)$", self.headers.get("Range", ""))
        if part and "no-ranges" not in modes:
            first, last = int(part[1]), min(int(part[2] or len(data)), len(data) - 1)
            if first > last:
                return self.refuse(416)
            total = len(data)
            data = data[first : last + 1]
            if with_body and happens("short"):
                data = data[: len(data) // 2]
            self.send_response(206)
            self.send_header("Content-Range", f"bytes {first}-{first + len(data) - 1}/{total}")
        else:
            self.send_response(200)
        if "no-ranges" not in modes:
            self.send_header("Accept-Ranges", "bytes")
        tag = file.with_name(file.name + ".tag")
        if tag.is_file():
            self.send_header("ETag", tag.read_text(encoding="utf-8").strip())
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        if not with_body:
            return None
        if happens("stall"):
            self.wfile.flush()
            time.sleep(3600)
        if happens("cut"):
            self.wfile.write(data[: len(data) * 3 // 4])
            self.wfile.flush()
            self.close_connection = True
            return None
        self.wfile.write(data)
        return None

    def do_HEAD(self):
        self.answer(False)

    def do_GET(self):
        self.answer(True)


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *_):  # clients that go away
        pass


server = Server(("127.0.0.1", 0), Handler)
print(server.server_address[1], flush=True)
server.serve_forever()
