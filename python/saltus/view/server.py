"""A small server for one page on this machine: videos and live pages talk to Python through it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from io import BufferedIOBase
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

Post = Callable[[bytes], str]
Stream = Callable[[BufferedIOBase], None]

MOST_BYTES = 2_000_000_000  # of a request; a video is the largest
PLAIN = "text/plain; charset=utf-8"


class PageServer:
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
    """

    def __init__(
        self,
        page: Callable[[], str],
        posts: Mapping[str, Post],
        streams: Mapping[str, Stream] | None = None,
    ) -> None:
        import secrets  # late, as all that is needed for few runs

        self.page, self.posts, self.streams = page, posts, dict(streams or {})
        self.token = secrets.token_urlsafe(16)
        self._http = _http_server(self)
        self.port = self._http.server_address[1]
        self._thread = threading.Thread(target=self._http.serve_forever, args=(0.05,), daemon=True)

    @property
    def url(self) -> str:
        """Address of the page."""
        return f"http://127.0.0.1:{self.port}/{self.token}/"

    def __enter__(self) -> PageServer:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._http.shutdown()
        self._http.server_close()
        self._thread.join()

    def get(self, request: BaseHTTPRequestHandler) -> None:
        """Answer with the page, or a stream of events."""
        name = self._name(request)
        if name == "":
            answer(request, 200, self.page().encode(), "text/html; charset=utf-8")
        elif name in self.streams:
            request.send_response(200)
            request.send_header("Content-Type", "text/event-stream")
            request.send_header("Cache-Control", "no-store")
            request.send_header("Connection", "close")
            request.end_headers()
            request.close_connection = True
            self.streams[name](request.wfile)
        else:
            answer(request, 404, b"there is no such page")

    def post(self, request: BaseHTTPRequestHandler) -> None:
        """Hand the body to whom it is for."""
        take = self.posts.get(self._name(request) or "")
        length = request.headers.get("Content-Length") or "0"
        if take is None or not length.isdigit() or int(length) > MOST_BYTES:
            request.close_connection = True  # its body is not read
            answer(request, 404, b"there is no such page")
            return
        body = request.rfile.read(int(length))
        try:
            answer(request, 200, take(body).encode())
        except (ValueError, RuntimeError) as error:
            answer(request, 400, str(error).encode())

    def _name(self, request: BaseHTTPRequestHandler) -> str | None:
        """Return what stands behind the token, None where it or the host is another."""
        if request.headers.get("Host") not in (f"127.0.0.1:{self.port}", f"localhost:{self.port}"):
            return None  # a name that somebody made point here
        from secrets import compare_digest

        token, _, name = request.path.removeprefix("/").partition("/")
        return name if compare_digest(token.encode(), self.token.encode()) else None


def answer(request: BaseHTTPRequestHandler, status: int, body: bytes, kind: str = PLAIN) -> None:
    """Answer a request with a whole body."""
    request.send_response(status)
    request.send_header("Content-Type", kind)
    request.send_header("Content-Length", str(len(body)))
    request.send_header("Cache-Control", "no-store")
    request.end_headers()
    request.wfile.write(body)


def _http_server(owner: PageServer) -> ThreadingHTTPServer:
    """Return a server on a free port; here, because its import takes a tenth of a second."""
    from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_GET(self) -> None:
            owner.get(self)

        def do_POST(self) -> None:
            owner.post(self)

        def log_message(self, format: str, *args: object) -> None:
            pass

    class Server(ThreadingHTTPServer):
        daemon_threads = True
        block_on_close = False

        def handle_error(self, request: object, client_address: object) -> None:
            pass  # pages that are closed break connections

    return Server(("127.0.0.1", 0), Handler)
