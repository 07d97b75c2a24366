"""A small server for one page on this machine: videos and live pages talk to Python through it."""

from __future__ import annotations

import secrets
import threading
from collections.abc import Callable, Mapping
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from io import BufferedIOBase

Post = Callable[[bytes], str]
Stream = Callable[[BufferedIOBase], None]

MOST_BYTES = 2_000_000_000  # of a request; a video is the largest


class PageServer(ThreadingHTTPServer):
    """Serves one page, takes its requests, and streams to it.

    Only this machine reaches it, and only under a path that nobody can guess: other pages in the
    same browser cannot.

    Parameters
    ----------
    page : callable
        Returns the HTML of the page.
    posts : mapping of names to callables
        What takes the body of a POST to a name, and returns the answer; a ValueError or
        RuntimeError it raises is the answer as well, with status 400.
    streams : mapping of names to callables
        What writes server-sent events until it returns, or writing fails because the page is gone.

    Attributes
    ----------
    url : str
        Of the page.
    """

    daemon_threads = True
    block_on_close = False

    def __init__(
        self,
        page: Callable[[], str],
        posts: Mapping[str, Post],
        streams: Mapping[str, Stream] | None = None,
    ) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.page, self.posts, self.streams = page, posts, dict(streams or {})
        self.token = secrets.token_urlsafe(16)
        self._thread = threading.Thread(target=self.serve_forever, args=(0.05,), daemon=True)

    @property
    def url(self) -> str:
        """Address of the page."""
        return f"http://127.0.0.1:{self.server_address[1]}/{self.token}/"

    def __enter__(self) -> PageServer:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()
        self.server_close()
        self._thread.join()

    def handle_error(self, request: object, client_address: object) -> None:
        """Say nothing: pages that are closed break connections."""


class Handler(BaseHTTPRequestHandler):
    """Answers one request of the page."""

    server: PageServer
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        """Answer with the page, or a stream of events."""
        name = self._name()
        if name == "":
            self._answer(200, self.server.page().encode(), "text/html; charset=utf-8")
        elif name in self.server.streams:
            self.send_response(200)
            self.send_header("Content-Type", "text/event-stream")
            self.send_header("Cache-Control", "no-store")
            self.send_header("Connection", "close")
            self.end_headers()
            self.close_connection = True
            self.server.streams[name](self.wfile)
        else:
            self._answer(404, b"there is no such page")

    def do_POST(self) -> None:
        """Hand the body to whom it is for."""
        post = self.server.posts.get(self._name() or "")
        length = int(self.headers.get("Content-Length") or 0)
        if post is None or not 0 <= length <= MOST_BYTES:
            self.close_connection = True
            self._answer(404, b"there is no such page")
            return
        body = self.rfile.read(length)
        try:
            self._answer(200, post(body).encode())
        except (ValueError, RuntimeError) as error:
            self._answer(400, str(error).encode())

    def log_message(self, format: str, *args: object) -> None:
        """Print nothing."""

    def _name(self) -> str | None:
        """Return what stands behind the token, None where it or the host is another."""
        port = self.server.server_address[1]
        if self.headers.get("Host") not in (f"127.0.0.1:{port}", f"localhost:{port}"):
            return None  # a name that somebody made point here
        token, _, name = self.path.removeprefix("/").partition("/")
        same = secrets.compare_digest(token.encode(), self.server.token.encode())
        return name if same else None

    def _answer(self, status: int, body: bytes, kind: str = "text/plain; charset=utf-8") -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(body)
