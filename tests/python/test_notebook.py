# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What notebooks show, in a browser."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "page"))
from browser import Browser, find_chromium  # noqa: E402

FRAME = "document.querySelector('iframe').contentWindow.crease"


@pytest.mark.skipif(not find_chromium(), reason="no Chromium here")
def test_the_frame_of_a_notebook_is_the_page(tmp_path, sheet):
    (tmp_path / "cell.html").write_text("<!doctype html><meta charset='utf-8'>" + sheet._repr_html_())
    browser = Browser(find_chromium(), tmp_path / "profile", 800, 640)
    try:
        browser.call("Page.navigate", url=(tmp_path / "cell.html").as_uri())
        browser.wait_for(f"window.frames.length && {FRAME} && {FRAME}.state !== 'loading'")
        assert browser.evaluate(f"{FRAME}.state") == "ready"
        kinds = [layer["kind"] for layer in browser.evaluate(f"{FRAME}.layers")]
        assert kinds == ["points", "surface", "net", "curves"]
    finally:
        browser.close()
