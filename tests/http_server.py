#!/usr/bin/env python3
"""Servers of files for tests, each on a port of its own, in one process, since Python takes long to start. Each answers one client after the
other.

http_server.py reads lines, words between tabs, until there are no more:
  start FOLDER [fail=N] [after=M] [retry-after=S] [cut=N] [short=N] [stall] [stall-once] [no-ranges] [log=FILE]
                 a server of a folder; its port is printed
  stop PORT      it takes no more calls, and what it was saying is cut off; its port is printed
Modes:
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
import socket
import sys
import threading


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def refuse(self, status):
        self.send_response(status)
        if status == 503 and self.server.value("retry-after"):
            self.send_header("Retry-After", self.server.value("retry-after"))
        self.send_header("Content-Length", "0")
        self.end_headers()

    def answer(self, with_body):
        server = self.server
        server.good_before -= 1
        if server.log:
            server.log.write(
                f"{self.command} {self.path} {self.headers.get('Range', '')} [{self.headers.get('User-Agent', '')}]\n"
            )
            server.log.flush()
        if server.happens("fail"):
            return self.refuse(503)
        file = server.folder / self.path.lstrip("/").partition("?")[0]
        if not file.is_file():
            return self.refuse(404)
        data = file.read_bytes()
        part = re.match(r"bytes=(\d+)-(\d*)$", self.headers.get("Range", ""))
        if part and "no-ranges" not in server.modes:
            first, last = int(part[1]), min(int(part[2] or len(data)), len(data) - 1)
            if first > last:
                return self.refuse(416)
            total = len(data)
            data = data[first : last + 1]
            if with_body and server.happens("short"):
                data = data[: len(data) // 2]
            self.send_response(206)
            self.send_header("Content-Range", f"bytes {first}-{first + len(data) - 1}/{total}")
        else:
            self.send_response(200)
        if "no-ranges" not in server.modes:
            self.send_header("Accept-Ranges", "bytes")
        tag = file.with_name(file.name + ".tag")
        if tag.is_file():
            self.send_header("ETag", tag.read_text(encoding="utf-8").strip())
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        if not with_body:
            return None
        if server.happens("stall"):
            self.wfile.flush()
            server.stopped.wait()
            self.close_connection = True
            return None
        if server.happens("cut"):
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

    def __init__(self, folder, modes):
        self.folder = pathlib.Path(folder)
        self.modes = modes
        self.left = {mode: self.number(mode) for mode in ("fail", "cut", "short")}
        self.left["stall"] = 10**9 if "stall" in modes else 1 if "stall-once" in modes else 0
        self.good_before = self.number("after")
        self.log = open(self.value("log"), "a", encoding="utf-8") if self.value("log") else None
        self.stopped = threading.Event()
        self.clients = []
        super().__init__(("127.0.0.1", 0), Handler)
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        self.timeout = None
        while not self.stopped.is_set():
            self.handle_request()

    def value(self, mode):
        return next((m.partition("=")[2] for m in self.modes if m.startswith(mode + "=")), "")

    def number(self, mode):
        return int(self.value(mode) or 0)

    def happens(self, fault):
        """Whether the fault is due now; each time that it is, one less is left."""
        if self.good_before >= 0 or self.left[fault] <= 0:
            return False
        self.left[fault] -= 1
        return True

    def process_request(self, request, client_address):
        self.clients.append(request)
        super().process_request(request, client_address)

    def handle_error(self, *_):  # clients that go away
        pass

    def stop(self):
        self.stopped.set()
        try:  # wakes the thread that waits for a call
            socket.create_connection(self.server_address).close()
        except OSError:
            pass
        self.thread.join()
        self.socket.close()
        for client in self.clients:
            try:
                client.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass


servers = {}
for line in sys.stdin:
    command, *words = line.rstrip("\n").split("\t")
    if command == "start":
        made = Server(words[0], words[1:])
        port = str(made.server_address[1])
        servers[port] = made
    else:
        port = words[0]
        servers.pop(port).stop()
    print(port, flush=True)
