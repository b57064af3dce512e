"""Reads the CSV, JSON, TOML and XML files of a run or sweep folder with the standard library of Python."""
import csv
import json
import sys
import tomllib
import xml.etree.ElementTree
from pathlib import Path


def read_numbers(path):
    with open(path, newline="") as file:
        head, *rows = csv.reader(file)
    assert all(len(row) == len(head) for row in rows), "rows of different lengths"
    for row in rows:
        for cell in row:
            float(cell or "nan")
    print(path.name, len(rows))


def read_results(path):
    with open(path / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    runs = json.loads((path / "results.json").read_text())["runs"]
    for row, run in zip(rows, runs, strict=True):
        assert None not in row and None not in row.values(), "rows of different lengths"
        assert row["folder"] == run["folder"] and row["verdict"] == run["verdict"], row
        speed = run["set"]["speed"]
        assert row["set.speed"] == speed if isinstance(speed, str) else float(row["set.speed"]) == speed, row
    print("results.csv", len(rows))


def read_run(path):
    record = json.loads((path / "run.json").read_text())
    scene = tomllib.loads((path / "scene.toml").read_text())
    assert record["until"] == scene["until"] and record["method"] == scene["method"]
    read_numbers(path / "history.csv")
    index = xml.etree.ElementTree.parse(path / "particles" / "particles.pvd")
    files = [data.get("file") for data in index.iter("DataSet")]
    assert all((path / "particles" / name).is_file() for name in files)
    print("particles.pvd", len(files))


folder = Path(sys.argv[1])
if (folder / "results.csv").exists():
    read_results(folder)
else:
    read_run(folder)
