"""The page: one HTML file with everything in it, which plays in any browser of today."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from saltus.records.replace import replacing
from saltus.view.arrays import deflated

BUNDLE = Path(__file__).parent / "page" / "bundle.js"

# The browser itself holds the promise that the page asks for nothing.
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; media-src blob:"
)
LIVE_POLICY = f"{POLICY}; connect-src 'self'"

# Unpacks and starts the bundle; says in words where the browser is too old for that.
LOADER = """\
(async () => {
  try {
    const text = document.getElementById('saltus-code').textContent;
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    const code = document.createElement('script');
    code.textContent = await new Response(stream).text();
    document.head.append(code);
  } catch (error) {
    document.body.textContent = 'This page needs a browser of 2023 or newer: ' + error.message;
  }
})();"""


def page_of(scene: Mapping[str, Any], *, policy: str = POLICY) -> str:
    """Return the page that shows a scene.

    Parameters
    ----------
    scene : mapping
        As `scene_of_run` returns it.
    policy : str
        The content security policy.

    Returns
    -------
    str
        HTML that asks for no other file.
    """
    from html import escape

    return f"""\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{escape(str(scene["title"]))} · saltus</title>
</head>
<body>
<noscript>This page needs JavaScript.</noscript>
<p>One moment. If this stays, the file is not whole, or its code was not let run.</p>
<script type="application/json" id="saltus-data">{_in_script(scene)}</script>
<script type="text/plain" id="saltus-code">{_code()}</script>
<script>{LOADER}</script>
</body>
</html>
"""


def write_page(path: str | os.PathLike[str], text: str) -> None:
    """Write a page; raise ModelError where no file can be written."""
    with replacing(path) as part:
        part.write_text(text, encoding="utf-8")


def in_frame(text: str, height: int) -> str:
    """Return a page as a frame of another one, as notebooks show it.

    Parameters
    ----------
    text : str
        HTML of the page.
    height : int
        [px]

    Returns
    -------
    str
        HTML.
    """
    from html import escape

    return (
        f'<iframe srcdoc="{escape(text)}" title="saltus" loading="lazy" allowfullscreen '
        f'style="width: 100%; height: {height}px; border: 1px solid #8884"></iframe>'
    )


def _in_script(scene: Mapping[str, Any]) -> str:
    """Return JSON that no name can end early: in a script element only "<" could."""
    return json.dumps(scene, separators=(",", ":")).replace("<", "\\u003c")


@cache
def _code() -> str:
    return deflated(BUNDLE.read_bytes())
