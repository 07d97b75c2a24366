"""A browser that all tests of pages share; without Chromium they are skipped, in words."""

from __future__ import annotations

import os

import pytest

from saltus import ModelError
from saltus.view.browser import VARIABLE, find_chromium


@pytest.fixture(scope="session")
def browser(tmp_path_factory):
    pytest.importorskip("websockets", reason="websockets is not installed: pip install websockets")
    try:
        find_chromium()
    except ModelError as error:
        if VARIABLE in os.environ:  # whoever names a browser wants these tests
            raise
        pytest.skip(str(error))
    from browser import Browser

    running = Browser(tmp_path_factory.mktemp("chromium"))
    yield running
    running.close()


@pytest.fixture
def open_page_of(browser):
    """Return what opens a file in a tab; tabs are closed after the test."""
    tabs = []

    def open_(path, size=(1100, 700), *, dark=False):
        tabs.append(browser.open(path.as_uri(), size, dark=dark).ready())
        return tabs[-1]

    yield open_
    for tab in tabs:
        tab.close()


@pytest.fixture
def open_page(open_page_of, tmp_path):
    """Return what writes the page of a run and opens it in a tab."""
    count = iter(range(100))

    def open_(run, size=(1100, 700), *, dark=False, **options):
        path = tmp_path / f"page{next(count)}.html"
        run.html(path, **options)
        return open_page_of(path, size, dark=dark)

    return open_
