#!/usr/bin/env python3
"""A server of files for tests, on a port of its own that it prints first. It answers one client after the other.

http_server.py FOLDER [fail=N] [after=M] [stall] [no-ranges]
  fail=N     N requests get the answer 503: the first, or those after M others
  stall      requests for bytes get headers and then nothing
  no-ranges  always the whole file, whatever part is asked for
"""
import http.server
import pathlib
import re
import sys
import time

folder = pathlib.Path(sys.argv[1])
modes = sys.argv[2:]


def number(mode):
    return next((int(m.partition("=")[2]) for m in modes if m.startswith(mode + "=")), 0)


failures = number("fail")
good_before = number("after")


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def refuse(self, status):
        self.send_response(status)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def answer(self, with_body):
        global failures, good_before
        good_before -= 1
        if good_before < 0 and failures > 0:
            failures -= 1
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
            self.send_response(206)
            self.send_header("Content-Range", f"bytes {first}-{last}/{len(data)}")
            data = data[first : last + 1]
        else:
            self.send_response(200)
        if "no-ranges" not in modes:
            self.send_header("Accept-Ranges", "bytes")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        if with_body and "stall" in modes:
            self.wfile.flush()
            time.sleep(3600)
        if with_body:
            self.wfile.write(data)

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
