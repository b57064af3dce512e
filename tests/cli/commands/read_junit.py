"""Prints the content of a JUnit file as JSON. If junitparser is installed, checks that it reads the same."""
import json
import sys
import xml.etree.ElementTree

try:
    import junitparser
except ImportError:
    junitparser = None


def with_junitparser(path):
    (suite,) = junitparser.JUnitXml.fromfile(path)
    cases = []
    for case in suite:
        results = [(type(result).__name__.lower(), result.message, result.text) for result in case.result]
        cases.append((case.name, case.classname, case.time, results))
    return suite.name, (suite.tests, suite.failures, suite.errors, suite.skipped), cases


def with_etree(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    assert root.tag == "testsuites", root.tag
    (suite,) = root
    assert suite.tag == "testsuite", suite.tag
    cases = []
    for case in suite:
        assert case.tag == "testcase", case.tag
        results = [(result.tag, result.get("message"), result.text) for result in case]
        time = case.get("time")
        cases.append((case.get("name"), case.get("classname"), time and float(time), results))
    counts = tuple(int(suite.get(name)) for name in ("tests", "failures", "errors", "skipped"))
    return suite.get("name"), counts, cases


def read(path):
    name, counts, cases = with_etree(path)
    if junitparser:
        assert with_junitparser(path) == (name, counts, cases), "junitparser and ElementTree read different contents"
    kinds = [kind for case in cases for kind, _, _ in case[3]]
    assert counts == (len(cases), kinds.count("failure"), kinds.count("error"), 0), counts
    for case, classname, _, results in cases:
        assert case and classname and len(results) <= 1, case
        for _, message, text in results:
            assert message and message == text, message
    return {
        "suite": name,
        "cases": [
            {"name": case, "class": classname, "time": time, "result": kind, "text": text}
            for case, classname, time, results in cases
            for kind, _, text in results or [("passed", None, None)]
        ],
    }


print(json.dumps(read(sys.argv[1])))
