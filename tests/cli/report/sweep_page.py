"""The page of a sweep, for test_page.py."""
from selenium.webdriver.common.keys import Keys


def check_sweep(browser, taut, folder):
    taut("sweep", "two-discs.toml", "--grid", "speed=1,2", "--grid", "method=oenog,tl,og", "--out", "sweep", "--quiet", "--render")
    taut("report", "sweep")
    browser.open(folder / "sweep/report/index.html")
    rows = lambda: [one.text for one in browser.all(".wide tbody tr")]
    assert len(rows()) == 6
    search = browser.one("input[type=search]")
    search.send_keys("method=tl")
    assert len(rows()) == 2
    assert len(browser.all(".map td button")) == 2
    search.send_keys(" speed<1.5")
    assert len(rows()) == 1
    search.clear()
    search.send_keys(Keys.SPACE)
    assert len(rows()) == 6
    head = lambda name: next(one for one in browser.all(".wide thead button") if one.text.startswith(name))
    column = lambda: [row["gap_value"] for row in read_rows(browser)]
    head("gap_value, m").click()
    ascending = column()
    assert ascending == sorted(ascending) and len(set(ascending)) > 1, ascending
    head("gap_value, m").click()
    assert column() == ascending[::-1]
    browser.select("Of", "gap_value")
    signs = [one.text for one in browser.all(".legend .sign")]  # the reference has none
    assert len(set(signs) - {""}) == 3, signs
    points = browser.script("return [...document.querySelectorAll('.plot canvas')].map((one) =>"
                            " Chart.getChart(one).data.datasets.flatMap((line) => line.data).filter((point) => point.row).length)")
    assert points == [4, 6], points  # error over cost: without og, which has no reference; response: all runs
    error_axis = lambda: browser.script("return Chart.getChart(document.querySelector('.plot canvas')).options.scales.y.title.text")
    for measure, unit in (("gap_rmse", "m"), ("gap_value", "share of the reference")):
        browser.select("Measure", measure)
        assert error_axis() == f"error of {measure}, {unit}", error_axis()
    cell = browser.all(".map td button")[0]
    name = cell.get_attribute("aria-label")
    browser.script("arguments[0].scrollIntoView({block: 'center'})", cell)
    cell.click()
    browser.until(lambda: browser.all("#run .player img"), "the run of a cell is shown")
    assert browser.one("#run h2[tabindex]").text == "Run " + name.split(":")[0]
    browser.keys(Keys.ARROW_RIGHT)
    assert browser.one(".player img").get_attribute("src").endswith("/frame_00001.png")


def check_references(browser, taut, folder):
    """References that depend on a swept parameter have a line each; absolute errors are not drawn among relative ones."""
    scene = (folder / "two-discs.toml").read_text()
    values = "values = { gap_value = 0.0005 }"
    assert values in scene
    scene = scene.replace('gap_rmse = "0.002 - 4*t" }', 'gap_rmse = "0.002 - 4*t", gap_value = "5e-4*(speed - 1)" }')
    (folder / "moving.toml").write_text(scene.replace(values, ""))
    taut("sweep", "moving.toml", "--grid", "speed=1,2,3", "--grid", "spacing=0.0025,0.002", "--out", "moving", "--quiet")
    taut("report", "moving")
    browser.open(folder / "moving/report/index.html")
    browser.select("Measure", "gap_value")
    browser.select("Of", "gap_value")
    names = lambda: browser.script("return [...document.querySelectorAll('.plot canvas')].map((one) =>"
                                   " Chart.getChart(one).data.datasets.map((line) => line.label))")
    errors, response = names()
    assert errors == ["oenog, speed=2", "oenog, speed=3"], errors
    assert "because the reference is 0: 2." in browser.one("main").text
    assert [name for name in response if name.startswith("reference")] == ["reference: made-up line"], response
    browser.one("section[aria-label=Response] option[value=spacing]").click()
    assert names()[1][3:] == [f"reference: made-up line, oenog, speed={speed}" for speed in (1, 2, 3)], names()


def read_rows(browser):
    """Rows of the table of runs; keys are the column heads up to the first comma."""
    heads = [one.text.split(",")[0].strip(" ▲▼") for one in browser.all(".wide thead button")]
    cells = browser.script("return [...document.querySelectorAll('.wide tbody tr')].map((row) =>"
                           " [...row.cells].map((cell) => cell.title || cell.textContent))")
    number = lambda text: float(text) if text.replace(".", "").replace("-", "").replace("e", "").isdigit() else text
    return [{head: number(text) for head, text in zip(heads, row)} for row in cells]
