# SPDX-License-Identifier: Apache-2.0
"""Starts the studio and talks to it, as a page does."""
import http.client
import json
import os
import signal
import subprocess
from pathlib import Path
from urllib.parse import urlsplit


class Studio:
    """`obvid studio FILE --no-browser`, until the block ends."""

    def __init__(self, program, *arguments):
        environment = {k: v for k, v in os.environ.items() if k != "OBVID_STUDIO_BUILDER"}
        self.process = subprocess.Popen(
            [program, "studio", *map(str, arguments), "--no-browser"], text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            raise SystemExit("the studio did not start: " + self.process.stderr.read())
        parts = urlsplit(self.address)
        self.host, self.token = parts.netloc, parts.query.removeprefix("token=")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self, by=signal.SIGINT):
        """Exit code."""
        if self.process.poll() is None:
            self.process.send_signal(by)
        code = self.process.wait(10)
        self.process.stdout.close()
        self.process.stderr.close()
        return code

    def connection(self):
        return http.client.HTTPConnection(self.host, timeout=20)

    def ask(self, method, path, body=None, headers=None):
        """Status, headers and body of one request with exactly these headers."""
        link = self.connection()
        try:
            link.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
            given = {"Host": self.host} | (headers or {})
            if body is not None:
                given.setdefault("Content-Length", str(len(body)))
            for name, value in given.items():
                if value is not None:
                    link.putheader(name, value)
            link.endheaders(body)
            answer = link.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read()
        finally:
            link.close()

    def job(self, kind, request):
        status, _, body = self.ask("POST", f"/api/{kind}", json.dumps(request).encode(),
                                   {"X-Obvid-Token": self.token})
        assert status == 200, (kind, status, body[:200])
        return json.loads(body)


def series10(root):
    rows = (Path(root) / "examples/series10.csv").read_text().split()[1:]
    return [[float(x) for x in row.split(",")] for row in rows]
