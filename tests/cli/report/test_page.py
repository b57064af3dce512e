#!/usr/bin/python3
"""test_page.py TAUT [run runs sweep ...]: makes results, writes their pages with `taut report`, and uses the pages in chromium.

Ends with 77 (skipped) if chromium, its driver or selenium are missing, but in continuous integration (CI is set) with 1.
"""
import contextlib
import csv
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = None
else:
    sys.dont_write_bytecode = True  # no files among the sources
    from sweep_page import check_references, check_sweep

SCENE = '''
title = "Two discs <script>alert(1)</script> & more"
spacing = 0.002
until = 0.002
method = "oenog"
[parameters]
speed = { value = 2.0, unit = "m/s", min = 0, help = "of each disc" }
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "left"
shape = { type = "disc", centre = [-0.011, 0], radius = 0.01 }
material = "rubber"
velocity = ["speed", 0]
[[body]]
name = "right"
shape = { type = "disc", centre = [0.011, 0], radius = 0.01 }
material = "rubber"
velocity = ["-speed", 0]
[[probe]]
name = "gap"
of = "gap"
bodies = ["left", "right"]
[[measure]]
name = "gap_rmse"
of = "rmse"
probe = "gap"
unit = "m"
[[measure]]
name = "gap_value"
of = "value"
probe = "gap"
time = 0.001
unit = "m"
[[reference]]
law = "neo-hookean"
name = "made-up line"
solutions = { gap_rmse = "0.002 - 4*t" }
values = { gap_value = 0.0005 }
[render]
color = "speed"
range = [0, 4]
view = [-0.03, 0.03, -0.02, 0.02]
size = [160, 120]
frames = 12
'''

BALL = '''
title = "A ball"
dim = 3
spacing = 0.004
until = 0.002
method = "oenog"
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "ball"
shape = { type = "ball", centre = [0, 0, 0], radius = 0.012 }
material = "rubber"
velocity = ["40*y", "20*z", "5*x"]
[render]
color = "speed"
size = [160, 120]
frames = 4
'''


SUITE = '''
title = "Discs <script>alert(1)</script> & more"
set = { speed = SPEED }
render = { frames = 2 }
[[entry]]
name = "discs"
scene = "two-discs.toml"
[[entry]]
name = "faster"
differs_from = "discs"
set = { speed = 4 }
'''


def skip(why):
    print(f"test_page.py: {why}")
    sys.exit(1 if os.environ.get("CI") else 77)


class Browser:
    """Headless chromium and the messages that a page logs."""

    def __init__(self, folder):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                     "--enable-unsafe-swiftshader", "--window-size=1280,1600", f"--user-data-dir={folder}"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_page_load_timeout(60)

    def open(self, page):
        self.driver.get(Path(page).resolve().as_uri())
        self.until(lambda: self.all("main section"), "the page has sections")
        self.until(lambda: len(self.all(".plots")) == len(self.all(".plots:has(canvas)")), "the histories are drawn")

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        found = self.all(selector)
        assert len(found) == 1, f"{len(found)} elements match {selector}"
        return found[0]

    def button(self, label):
        found = [one for one in self.all("button") if label in (one.get_attribute("aria-label"), one.text)]
        assert len(found) == 1, f"{len(found)} buttons are called {label}"
        return found[0]

    def select(self, label, text):
        for one in self.all("label"):
            if one.text.split("\n")[0].startswith(label):
                for option in one.find_elements(By.TAG_NAME, "option"):
                    if option.text == text:
                        return option.click()
        raise AssertionError(f"no choice {label} with {text}")

    def keys(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    def until(self, condition, what):
        end = time.monotonic() + 30
        while not condition():
            assert time.monotonic() < end, f"waited in vain until {what}"
            time.sleep(0.02)

    def errors(self):
        """Errors and warnings of the console, except those of the software renderer."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING") and "GL Driver Message" not in entry["message"]]


def frame_of(browser, player=0):
    return browser.all(".player img")[player].get_attribute("src").split("/")[-1]


def check_player(browser):
    assert frame_of(browser) == "frame_00000.png"
    alt = browser.one(".player img").get_attribute("alt")
    assert alt.startswith("Frame 1 of 13 of two-discs with oenog, t = 0 s"), alt
    browser.button("Next frame").click()
    assert frame_of(browser) == "frame_00001.png"
    browser.keys(Keys.HOME)
    browser.script("document.activeElement.blur()")
    browser.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert frame_of(browser) == "frame_00002.png"
    browser.keys(Keys.ARROW_LEFT)
    assert frame_of(browser) == "frame_00001.png"
    browser.keys(Keys.END)
    assert frame_of(browser) == "frame_00012.png"
    browser.until(lambda: browser.script("return document.querySelector('.player img').naturalWidth") == 160, "a frame is drawn")
    browser.keys(Keys.HOME)
    browser.keys(Keys.SPACE)  # plays to the end
    browser.until(lambda: frame_of(browser) == "frame_00012.png", "the run was played")
    assert browser.button("Play")
    slider = browser.one("input[type=range]")
    browser.script("arguments[0].value = 5; arguments[0].dispatchEvent(new Event('input'))", slider)
    assert frame_of(browser) == "frame_00005.png"
    assert "frame 6 of 13" in slider.get_attribute("aria-valuetext")


def check_hover(browser, run):
    """The values under the pointer are those of history.csv, to the last digit."""
    rows = list(csv.DictReader(open(run / "history.csv")))
    canvas = browser.all(".plot canvas")[0]
    browser.script("arguments[0].scrollIntoView({block: 'center'})", canvas)
    ActionChains(browser.driver).move_to_element_with_offset(canvas, 60, 10).perform()
    tip = lambda: browser.script(
        "const tip = Chart.getChart(arguments[0]).tooltip; return tip.opacity ? [tip.title, tip.body.map((b) => b.lines[0])] : null",
        canvas)
    browser.until(tip, "a value is shown under the pointer")
    title, lines = tip()
    shown_time = float(title[0].split("=")[1].split()[0])
    row = min(rows, key=lambda row: abs(float(row["t"]) - shown_time))
    assert float(row["t"]) == shown_time, (title, row["t"])
    value = next(line for line in lines if line.startswith("gap:")).split()[1]
    assert float(value) == float(row["gap"]), (lines, row)
    assert any(line.startswith("reference: made-up line: ") for line in lines), lines


def check_zoom_and_columns(browser):
    canvas = browser.all(".plot canvas")[0]
    ends = lambda: browser.script("const x = Chart.getChart(document.querySelector('.plot canvas')).scales.x; return [x.min, x.max]")
    whole = ends()
    ActionChains(browser.driver).move_to_element_with_offset(canvas, -100, 0).click_and_hold().move_by_offset(150, 0).release().perform()
    zoomed = ends()
    assert whole[0] < zoomed[0] < zoomed[1] < whole[1], (whole, zoomed)
    browser.button("Whole run").click()
    assert ends() == whole
    for summary in browser.all("summary"):
        if summary.text == "Columns":
            summary.click()
    browser.one("input[type=checkbox][value=kinetic_energy]").click()
    titles = [one.text for one in browser.all(".plot h3")]
    assert titles == ["kinetic_energy, J per m", "gap, m"], titles


def check_texts(browser):
    """A title is not run as a script; the page contains the command, the measures and the scene."""
    assert "<script>alert(1)</script>" in browser.one("h1").text
    assert not browser.script("return [...document.scripts].some((one) => one.text === 'alert(1)')")
    text = browser.script("return document.body.textContent")
    for part in ("gap_value", "made-up line", "taut run", "scene.toml", "youngs_modulus", "Libraries", "speed"):
        assert part in text, part
    assert browser.script("return [...document.images].every((one) => one.hasAttribute('alt'))")
    assert browser.script("return [...document.querySelectorAll('button, select, input')].every((one) =>"
                          " one.textContent.trim() || one.ariaLabel || one.closest('label'))")


def check_errors(browser):
    """The error of a value is a share of its reference; the error of a curve has a unit."""
    rows = {row.text.split()[0]: row.text for row in browser.all("section[aria-label=Measures] tbody tr")}
    assert rows["gap_rmse"].endswith(" m") and rows["gap_value"].endswith(" %"), rows


def check_theme(browser):
    theme = lambda: browser.script("return [document.documentElement.dataset.theme, getComputedStyle(document.body).backgroundColor]")
    before = theme()
    browser.one("header button").click()
    after = theme()
    assert before[0] != after[0] and before[1] != after[1], (before, after)
    browser.one("header button").click()
    assert theme() == before


def check_run(browser, taut, folder):
    taut("report", "run")
    browser.open(folder / "run/report/index.html")
    check_texts(browser)
    check_errors(browser)
    check_player(browser)
    check_hover(browser, folder / "run")
    check_zoom_and_columns(browser)
    check_theme(browser)


def check_runs(browser, taut, folder):
    taut("run", "two-discs.toml", "--method", "tl", "--out", "tl", "--frames", "6", "--quiet")
    taut("report", "run", "tl", "--out", "both")
    browser.open(folder / "both/index.html")
    frames = lambda: [frame_of(browser, k) for k in (0, 1)]
    assert frames() == ["frame_00000.png"] * 2, frames()
    browser.keys(*[Keys.ARROW_RIGHT] * 4)
    assert frames() == ["frame_00004.png", "frame_00002.png"], frames()  # the same time
    lines = browser.script("return Chart.getChart(document.querySelector('.plot canvas')).data.datasets.map((one) => one.label)")
    assert lines == ["run", "tl", "reference: made-up line"], lines
    heads = [one.text for one in browser.all("thead th")]
    assert heads == ["measure", "run", "tl", "reference"], heads


def check_difference(browser, taut, folder):
    shutil.copytree(folder / "run/frames", folder / "expected")
    shutil.copyfile(folder / "run/frames/frame_00012.png", folder / "expected/frame_00003.png")
    taut("report", "run", "--baseline", "expected", "--out", "difference")
    browser.open(folder / "difference/index.html")
    names = [one.text.split("\n")[0] for one in browser.all(".thumbs button")]
    assert names[0] == "frame_00003.png" and len(names) == 13, names
    assert "1 of 13 pictures differ" in browser.one("main").text
    shown = lambda: [one.get_attribute("src").split("/")[-2:] for one in browser.all(".compare img")]
    assert shown() == [["expected", "frame_00003.png"], ["frames", "frame_00003.png"], ["difference", "frame_00003.png"]], shown()
    browser.button("slider").click()
    slider = browser.one("input[type=range]")
    slider.send_keys(*[Keys.ARROW_RIGHT] * 10)
    assert "40%" in browser.one(".over .top").get_attribute("style"), browser.one(".over .top").get_attribute("style")
    browser.button("blink").click()
    hidden = lambda: browser.script("return document.querySelector('.over .top').hidden")
    browser.until(hidden, "the other picture blinks")
    browser.until(lambda: not hidden(), "the picture blinks back")
    browser.button("side by side").click()
    browser.script("document.activeElement.blur()")
    browser.keys(Keys.ARROW_RIGHT)
    assert shown()[0][1] == names[1]


def check_suite(browser, taut, folder):
    write = lambda speed: (folder / "suite.toml").write_text(SUITE.replace("SPEED", speed))
    write("2")
    taut("snapshot", "suite.toml", "--update", "--quiet")
    write("2.5")
    taut("snapshot", "suite.toml", "--quiet", code=1)
    taut("report", "out/snapshot-suite")
    browser.open(folder / "out/snapshot-suite/report/index.html")
    assert "1 of 2 entries failed" in browser.one("#head").text, browser.one("#head").text
    rows = [one.text.replace("\n", " ") for one in browser.all(".entries tbody tr")]
    assert rows[0].startswith("discs ≠ different 3 3 frame_0000"), rows
    assert "differs, as it must" in rows[1], rows
    shown = lambda: [one.get_attribute("src").split("/")[-2:] for one in browser.all(".compare img")]
    assert [one[0] for one in shown()] == ["discs", "frames", "discs"], shown()
    browser.button("blink").click()
    browser.button("faster").click()
    assert browser.one(".entries button[aria-pressed=true]").text == "faster"
    assert "must differ from the baseline of discs" in browser.one("main").text
    browser.script("document.activeElement.blur()")
    before = shown()
    browser.keys(Keys.ARROW_RIGHT)
    assert shown() != before
    shutil.rmtree(folder / "out/snapshot-suite/discs/frames")
    taut("report", "out/snapshot-suite")
    browser.open(folder / "out/snapshot-suite/report/index.html")
    browser.button("faster").click()
    browser.button("discs").click()
    assert "no pictures" in browser.one("main").text, browser.one("main").text
    assert browser.script("return document.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', cancelable: true}))")


def check_embedded(browser, taut, folder):
    taut("report", "run", "--embed", "--out", "alone/page.html")
    assert [one.name for one in (folder / "alone").iterdir()] == ["page.html"]
    browser.open(folder / "alone/page.html")
    browser.keys(Keys.END)
    browser.until(lambda: browser.script("return document.querySelector('.player img').naturalWidth") == 160, "a frame is drawn")
    assert browser.one(".player img").get_attribute("src").startswith("data:image/webp")
    assert browser.script("return performance.getEntriesByType('resource').filter((one) => !one.name.startsWith('data:')).length") == 0


def check_orbit(browser, taut, folder):
    (folder / "ball.toml").write_text(BALL)
    taut("run", "ball.toml", "--out", "ball", "--save-particles", "--quiet")
    taut("report", "ball")
    browser.open(folder / "ball/report/index.html")
    canvas = "document.querySelector('.orbit canvas')"
    browser.until(lambda: browser.all(".orbit canvas"), "the particles are loaded")
    picture = lambda: browser.script(f"return {canvas}.toDataURL()")
    colors = browser.script(f"const gl = {canvas}.getContext('webgl'), all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);"
                            "gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, all);"
                            "return new Set(new Uint32Array(all.buffer)).size")
    assert colors > 20, colors  # shaded particles on white
    seen = [picture()]

    def changes(what):
        seen.append(picture())
        assert seen[-1] != seen[-2], what

    view = browser.one(".orbit canvas")
    browser.script("arguments[0].scrollIntoView({block: 'center'})", view)
    for name in ("Turn right", "Raise"): browser.button(name).click()
    changes("turning")
    browser.button("Reset view").click()
    ActionChains(browser.driver).move_to_element(view).click_and_hold().move_by_offset(30, 30).release().perform()
    assert picture() == seen[-1], "dragging by 30 px to the right and down is like both buttons"
    assert browser.script("const orbit = new Orbit(taut_particles[0]), near = orbit.axes()[2]; orbit.turned += 0.1; orbit.raised += 0.1;"
                          "const [right, up] = orbit.axes().map((axis) => axis.reduce((sum, x, k) => sum + x * near[k], 0));"
                          "return right > 0 && up < 0"), "the near side moves to the right and down"
    view.send_keys(Keys.ARROW_LEFT)
    changes("an arrow key turns")
    assert frame_of(browser) == "frame_00000.png"  # turning does not change the frame
    browser.button("+").click()
    changes("zooming")
    cut = next(one for one in browser.all("input[type=range]") if one.get_attribute("aria-label") == "Place of the cut")
    browser.script("arguments[0].value = 500; arguments[0].dispatchEvent(new Event('input'))", cut)
    changes("the cut")
    browser.script("document.activeElement.blur()")
    browser.keys(Keys.END)
    changes("time")
    assert "t = 0.002 s" in browser.one("main").text


def check_refresh(browser, taut, folder):
    """The page of a running simulation shows newer data, at the same frame."""
    shutil.copytree(folder / "run", folder / "live", ignore=shutil.ignore_patterns("report*"))
    record = (folder / "live/run.json").read_text()
    (folder / "live/run.json").write_text(record.replace('"status": "finished"', '"status": "running"'))
    moved = folder / "live/frames/frame_00012.png"
    picture = moved.read_bytes()
    moved.unlink()
    taut("report", "live")
    browser.open(folder / "live/report/index.html")
    assert "still running" in browser.one("main").text
    browser.script("document.querySelector('main').firstChild.id = 'old'")
    time.sleep(5)
    assert browser.all("#old")  # without new data nothing is built again
    browser.keys(*[Keys.ARROW_RIGHT] * 3)
    assert "frame 4 of 12" in browser.one("figcaption").text
    (folder / "live/run.json").write_text(record)
    moved.write_bytes(picture)
    taut("report", "live", "--watch")  # ends because the run has ended
    browser.until(lambda: "frame 4 of 13" in browser.script("return document.querySelector('figcaption').textContent"), "the page has the new frame")
    assert "still running" not in browser.one("main").text


CHECKS = [] if webdriver is None else [check_run, check_runs, check_sweep, check_references, check_difference, check_suite,
                                       check_embedded, check_orbit, check_refresh]


def main():
    checks = [check for check in CHECKS if len(sys.argv) < 3 or check.__name__[6:] in sys.argv[2:]]
    program = Path(sys.argv[1]).resolve()
    if webdriver is None or not shutil.which("chromium") or not shutil.which("chromedriver"):
        skip("needs chromium, chromium-driver and python3-selenium")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        (folder / "two-discs.toml").write_text(SCENE)

        def taut(*words, code=0):
            done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
            assert done.returncode == code, (words, done.stdout, done.stderr)

        taut("run", "two-discs.toml", "--out", "run", "--quiet")
        browser = Browser(folder / "profile")
        with contextlib.closing(type("Ends", (), {"close": browser.driver.quit})()):
            for check in checks:
                check(browser, taut, folder)
                text = browser.script("return document.body.innerText")
                assert not [word for word in ("[object", "undefined", "NaN") if word in text], text
                errors = browser.errors()
                assert not errors, (check.__name__, errors)
                print(f"{check.__name__}: fine")


if __name__ == "__main__":
    main()
