"""Runs to look at: a page of one file that plays in a browser, videos made from it, live pages."""

from saltus.view.live import serve
from saltus.view.show import html, notebook_html, show
from saltus.view.video import video

__all__ = ["html", "notebook_html", "serve", "show", "video"]
