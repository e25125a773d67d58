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
import time

from browser import Browser, Picture, find_chromium

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
    expect([layer["count"] for layer in layers][0::2] == [154, 8], "all points and control points are there")
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
    expect(picked and picked["kind"] == "point" and picked["index"] == 0 and picked["layer"] == 0,
           "a click picks the point under it")
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
    browser.drag((480, 560), (400, 600))
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


LEFT, RIGHT = "[-0.55, -0.2, -0.33]", "[0.55, -0.2, -0.33]"  # places on the two sides of the roof


def click_place(browser, place):
    spot = browser.evaluate(f"crease.place({place})")
    browser.click(spot["x"], spot["y"])


def check_faces_and_edges(browser, folder):
    browser.click_on("#reach input[value=face]")
    click_place(browser, LEFT)
    picked = browser.evaluate("crease.picked")
    expect(picked["kind"] == "face" and picked["item"] == 0, "a click picks the face under it")
    text = browser.text("#picked")
    expect("Face 0: plane" in text and "rms\t0.0125" in text, "the page tells its type and its rms")
    expect("0.85749" in text and "\u00b1 0.002" in text, "its normal, and the standard error beside it")
    browser.picture(os.path.join(folder, "page_face.png"))
    browser.key("f", "KeyF")
    expect(browser.evaluate("crease.picked.item") == 1, "F goes to the next face")
    browser.key("F", "KeyF", shift=True)
    expect(browser.evaluate("crease.picked.item") == 0, "shift and F to the one before")
    browser.key("Escape")
    browser.click_on("#reach input[value='']")
    click_place(browser, "[0, 0.3, 0]")
    text = browser.text("#picked")
    expect(browser.evaluate("crease.picked.kind") == "edge" and "straight" in text, "a click picks an edge")
    expect("118.070\u00b0 \u00b1 0.25\u00b0" in text, "and the page tells its angle with its standard error")
    browser.key("Escape")


def check_measuring(browser, folder):
    browser.click_on("#reach input[value=face]")
    browser.click_on("#tool-measure")
    click_place(browser, LEFT)
    click_place(browser, RIGHT)
    rows = {row["name"]: row["value"] for row in browser.evaluate("crease.measured")}
    expect(abs(rows["angle between the planes"] - 61.9275) < 1e-3, "two faces: the angle of their planes")
    expect("61.928\u00b0" in browser.text("#overlay"), "it stands beside the line")
    browser.picture(os.path.join(folder, "page_measure.png"))
    browser.click_on("#reach input[value=point]")
    spots = browser.evaluate("[0, 17].map((point) => crease.spot(0, point))")
    for spot in spots:
        browser.click(spot["x"], spot["y"])
    rows = {row["name"]: row["value"] for row in browser.evaluate("crease.measured")}
    expect(abs(rows["distance of the picks"] - (1.5 ** 2 + 0.5 ** 2 + 0.9 ** 2) ** 0.5) < 1e-6, "two points: their distance")
    browser.click_on("#reach input[value='']")
    browser.key("Escape")
    browser.key("m", "KeyM")
    expect(browser.evaluate("crease.tool") == "pick" and not browser.evaluate("crease.picked"), "M ends it")


def is_outline(red, green, blue):
    return red > 190 and 90 < green < 160 and blue < 60


def check_section(browser, folder, first):
    browser.click_on("#tool-section")
    expect(browser.evaluate("crease.section.on && crease.section.axis === 'x' && crease.section.at === 0"),
           "a section across x through the middle")
    cut = browser.picture(os.path.join(folder, "page_section.png"))
    expect(cut.count(is_surface, PANEL) < 0.75 * first.count(is_surface, PANEL), "half of the roof is gone")
    browser.click_on("#section [data-axis=y]")
    browser.key("[", "BracketLeft")
    expect(abs(browser.evaluate("crease.section.at") + 0.04) < 1e-6, "[ shifts it by a fiftieth")
    expect(browser.picture().count(is_outline, PANEL) > 100, "where it cuts the faces is an outline")
    browser.evaluate("document.querySelector('#cut').focus()")
    browser.key("ArrowRight")
    expect(abs(browser.evaluate("crease.section.at") + 0.038) < 1e-6, "its slider takes arrow keys")
    browser.evaluate("document.querySelector('#view').focus()")
    browser.key("f", "KeyF")
    browser.key("n", "KeyN")
    expect(browser.evaluate("crease.section.axis") == "n", "N: across the normal of what is picked")
    browser.click_on("#cut-off")
    browser.key("Escape")
    expect(browser.picture().differs(first, PANEL) < 0.002, "without it all is back")


def check_range(browser, first):
    box = browser.evaluate("(() => { const e = document.querySelector('#to'); e.scrollIntoView({block: 'center'}); "
                           "const r = e.getBoundingClientRect(); return [r.left, r.top + r.height / 2, r.width, "
                           "Number(e.value) / 1000]; })()")
    before = browser.evaluate("crease.colouring.range")
    x = box[0] + 7 + (box[2] - 14) * box[3]
    browser.drag((x, box[1]), (x - 90, box[1]))
    after = browser.evaluate("crease.colouring.range")
    expect(after[0] == before[0] and after[1] < 0.8 * before[1], "dragging a thumb narrows the range")
    expect(browser.picture().differs(first, PANEL) > 0.001, "and colours change")
    browser.click_on("#whole")
    expect(browser.evaluate("crease.colouring.range") == before, "Reset brings the proposed range back")


def check_picture(browser, folder):
    folder = os.path.abspath(folder)
    for name in os.listdir(folder):
        if name.startswith("Roof"):
            os.remove(os.path.join(folder, name))
    browser.call("Page.setDownloadBehavior", behavior="allow", downloadPath=folder)
    browser.key("p", "KeyP")
    browser.wait_for("crease.saved")
    path = os.path.join(folder, browser.evaluate("crease.saved"))
    for _ in range(100):
        if os.path.exists(path) and os.path.getsize(path) > 0:
            break
        time.sleep(0.05)
    with open(path, "rb") as file:
        saved = Picture(file.read())
    expect((saved.width, saved.height) == (WIDTH, HEIGHT), "P saves a picture of what is seen")
    expect(saved.count(is_net) > 300 and saved.count(is_crease) > 300, "with the net and the crease in it")


def check_help(browser):
    browser.key("?", "Slash", shift=True)
    expect(browser.evaluate("document.querySelector('#help').open"), "? lists the keys")
    browser.key("Escape")
    expect(not browser.evaluate("document.querySelector('#help').open"), "Escape closes the list")
    browser.key("Tab")
    named = browser.evaluate("[...document.querySelectorAll('button, input, select, canvas[tabindex]')].every((e) => "
                             "e.innerText || e.ariaLabel || e.title || e.labels?.[0]?.innerText || e.closest('label'))")
    expect(named, "everything that can be reached has a name for those who do not see it")
    browser.evaluate("document.querySelector('#unit').value = 'mm'; document.querySelector('#unit').dispatchEvent(new Event('change'))")
    expect("2\u00a0mm" in browser.text("#counts"), "lengths carry the unit that was chosen")
    browser.evaluate("document.querySelector('#unit').value = ''; document.querySelector('#unit').dispatchEvent(new Event('change'))")


def check_touch(browser):
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    browser.evaluate("crease.look('home')")
    distance = "(() => { const [a, b] = [1, 17].map((p) => crease.spot(0, p)); return Math.hypot(a.x - b.x, a.y - b.y); })()"
    before, spot = browser.evaluate(distance), browser.evaluate("crease.spot(0, 1)")
    browser.swipe([(150, 200)], [(210, 230)])
    turned = browser.evaluate("crease.spot(0, 1)")
    expect(abs(turned["x"] - spot["x"]) + abs(turned["y"] - spot["y"]) > 10, "one finger turns the scene")
    browser.evaluate("crease.look('home')")
    browser.swipe([(150, 250), (210, 250)], [(90, 250), (270, 250)])
    expect(browser.evaluate(distance) > 1.5 * before, "two fingers apart zoom in")
    browser.evaluate("crease.look('home')")
    browser.swipe([(150, 250), (210, 250)], [(150, 320), (210, 320)])
    expect(browser.evaluate("crease.spot(0, 1).y") > spot["y"] + 40, "two fingers together move it")
    browser.evaluate("crease.look('home')")
    spot = browser.evaluate("crease.spot(0, 0)")
    browser.tap(spot["x"], spot["y"])
    expect(browser.evaluate("crease.picked?.index") == 0, "a tap picks")
    browser.call("Emulation.setTouchEmulationEnabled", enabled=False)


def check_frames(browser, folder):
    browser.prefer("dark")
    dark = browser.picture(os.path.join(folder, "page_dark.png"))
    expect(dark.count(lambda r, g, b: max(r, g, b) < 60) > 0.4 * WIDTH * HEIGHT, "dark where that is preferred")
    browser.key("t", "KeyT")
    expect(not browser.evaluate("document.documentElement.classList.contains('dark')"), "T chooses light all the same")
    browser.prefer("light")
    browser.resize(360, 640)
    browser.rest_frames()
    expect(browser.evaluate("document.querySelector('#controls').hidden"), "a phone has the panel folded")
    check_touch(browser)
    browser.picture(os.path.join(folder, "page_narrow.png"))
    browser.click_on("#let-go")
    browser.click_on("#fold")
    browser.evaluate("crease.look('home')")
    browser.picture(os.path.join(folder, "page_narrow_panel.png"))
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
    check_faces_and_edges(browser, folder)
    check_measuring(browser, folder)
    check_section(browser, folder, first)
    check_range(browser, first)
    check_picture(browser, folder)
    check_help(browser)
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
