#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Opens a page written by make_page in Chromium, clicks, and looks at what is drawn.

check_page.py MAKE_PAGE FOLDER: the page and pictures of it are left in FOLDER. Ends with 77 when no
Chromium is installed.
"""

import os
import subprocess
import sys
import tempfile

from browser import Browser, find_chromium

WIDTH, HEIGHT, PANEL = 900, 640, 290


def is_surface(red, green, blue):
    return blue > red + 15 and 90 < green < 235 and red > 80 and abs(green - (red + blue) / 2) < 25


def is_net(red, green, blue):
    return red > 150 and green < 70 and blue < 70


def is_crease(red, green, blue):
    return red < 60 and green < 60 and blue < 70


def is_one_colour(red, green, blue):
    return green > red + 60 and green > blue + 40


def expect(true, sentence):
    if not true:
        raise AssertionError(sentence)
    print("ok:", sentence)


def check_start(browser, folder):
    browser.wait_for("window.crease && crease.state !== 'loading'")
    state, message = browser.evaluate("[crease.state, crease.message]")
    expect(state == "ready", f"the page is ready {message}")
    layers = browser.evaluate("crease.layers")
    expect([layer["kind"] for layer in layers] == ["points", "surface", "net", "curves"], "four layers")
    expect([layer["count"] for layer in layers][0::2] == [154, 6], "all points and control points are there")
    title = 'Roof </title><img src=x onerror="window.hacked = 1"> & co'
    expect(browser.evaluate("document.title") == title, "the title is the one given")
    expect(browser.evaluate("document.querySelector('h1').textContent") == title, "so is the heading")
    expect(browser.evaluate("window.hacked === undefined && !document.querySelector('img')"),
           "a title that holds HTML stays text")
    first = browser.picture(os.path.join(folder, "page.png"))
    expect(first.count(is_surface, PANEL) > 15000, "the surface is drawn")
    expect(first.count(is_net, PANEL) > 300, "the control net is drawn in red")
    expect(first.count(is_crease, PANEL) > 300, "the crease is drawn dark")
    return first


def check_layers(browser, first):
    browser.click_on("#layer-1")
    without = browser.picture()
    expect(not browser.evaluate("crease.layers[1].visible"), "a click on its box hides the surface")
    expect(without.count(is_surface, PANEL) < 0.1 * first.count(is_surface, PANEL), "and it is gone")
    browser.click_on("#layer-2")
    expect(browser.picture().count(is_net, PANEL) < 100, "a click on its box hides the net")
    browser.click_on("#layer-1")
    browser.click_on("#layer-2")
    expect(browser.picture().differs(first, PANEL) < 0.002, "two further clicks bring both back")


def check_pick(browser, folder):
    spot = browser.evaluate("crease.spot(0, 0)")
    browser.click(spot["x"], spot["y"])
    picked = browser.evaluate("crease.picked")
    expect(picked and picked["index"] == 0 and picked["layer"] == 0, "a click picks the point under it")
    expect(max(abs(a - b) for a, b in zip(picked["position"], (-0.5, -0.5, 0.3))) < 1e-6,
           "its coordinates are those of the cloud")
    expect(picked["values"]["variance"] == 1, "its values are those of the fields")
    text = browser.evaluate("document.querySelector('#picked').innerText")
    expect("variance" in text and "height <b>" in text and "0.3" in text, "and the page shows them")
    browser.picture(os.path.join(folder, "page_picked.png"))
    browser.evaluate("document.querySelector('#view').focus()")
    browser.key("Escape")
    expect(browser.evaluate("crease.picked") is None, "Escape lets the point go")
    browser.click(PANEL + 12, HEIGHT - 12)
    expect(browser.evaluate("crease.picked") is None, "a click beside all points picks none")


def check_colours(browser):
    expect(browser.evaluate("crease.colouring.field") == "variance", "variance colours the points at first")
    browser.evaluate("(() => { const s = document.querySelector('#field'); s.value = ''; "
                     "s.dispatchEvent(new Event('change')); })()")
    expect(browser.picture().count(is_one_colour, PANEL) > 500, "one colour: the paper's green")
    expect(browser.evaluate("document.querySelector('#scale').hidden"), "without a bar")
    browser.evaluate("crease.colourBy('height <b>')")
    expect(browser.evaluate("crease.colouring.range[0] === -crease.colouring.range[1]"),
           "values of both signs get a range even about zero")
    expect(browser.picture().count(is_one_colour, PANEL) < 50, "and other colours")
    browser.evaluate("crease.colourBy('variance')")


def check_views(browser, folder, first):
    browser.drag((700, 100), (560, 160))
    expect(browser.picture().differs(first, PANEL) > 0.05, "dragging turns the scene")
    browser.click_on("#views button")
    expect(browser.picture().differs(first, PANEL) < 0.002, "home is where it began")
    browser.evaluate("document.querySelector('#view').focus()")
    browser.key("6", "Digit6")
    browser.picture(os.path.join(folder, "page_top.png"))
    spots = browser.evaluate("[1, 17].map((point) => crease.spot(0, point))")
    expect(abs(spots[0]["y"] - spots[1]["y"]) < 0.5 and spots[0]["x"] < spots[1]["x"],
           "from above x runs to the right")
    browser.key("1", "Digit1")
    browser.key("ArrowLeft")
    expect(browser.picture().differs(first, PANEL) > 0.05, "arrow keys turn the scene")
    browser.key("1", "Digit1")
    browser.mouse("mouseWheel", 600, 350, button="none", deltaX=0, deltaY=-300)
    browser.rest_frames()
    expect(browser.picture().differs(first, PANEL) > 0.05, "the wheel zooms")
    browser.key("1", "Digit1")


def check_frames(browser, folder):
    browser.prefer("dark")
    dark = browser.picture(os.path.join(folder, "page_dark.png"))
    expect(dark.count(lambda r, g, b: max(r, g, b) < 60) > 0.4 * WIDTH * HEIGHT, "dark where that is preferred")
    browser.prefer("light")
    browser.resize(360, 640)
    browser.evaluate("crease.look('home')")
    browser.picture(os.path.join(folder, "page_narrow.png"))
    expect(browser.evaluate("document.documentElement.scrollWidth <= innerWidth"), "nothing is wider than a phone")
    spots = browser.evaluate("[0, 1, 17, 153].map((point) => crease.spot(0, point))")
    top = browser.evaluate("document.querySelector('#panel').getBoundingClientRect().top")
    expect(all(0 < s["x"] < 360 and 0 < s["y"] < top for s in spots), "and the scene stands above the panel")


def check_quiet(browser):
    faults = [event for event in browser.events
              if event.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded")
              or (event.get("method") == "Runtime.consoleAPICalled" and event["params"]["type"] in ("error", "warning"))]
    faults = [fault for fault in faults if "ReadPixels" not in str(fault) and "favicon" not in str(fault)]
    expect(not faults, f"no errors, no warnings {faults[:2] or ''}")
    urls = [event["params"]["request"]["url"] for event in browser.events
            if event.get("method") == "Network.requestWillBeSent"]
    expect(all(url.startswith(("file:", "data:", "about:")) for url in urls), "nothing is asked of any network")


def check(browser, page, folder):
    browser.call("Page.navigate", url="file://" + page)
    first = check_start(browser, folder)
    check_layers(browser, first)
    check_pick(browser, folder)
    check_colours(browser)
    check_views(browser, folder, first)
    check_frames(browser, folder)
    check_quiet(browser)


def main(make_page, folder):
    page = os.path.join(os.path.abspath(folder), "page.html")
    subprocess.run([make_page, page], check=True)
    chromium = find_chromium()
    if not chromium:
        print("SKIPPED: no chromium is installed, so the page was written but not looked at")
        return 77
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(chromium, profile, WIDTH, HEIGHT)
        try:
            check(browser, page, folder)
        finally:
            browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
