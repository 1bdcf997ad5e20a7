# SPDX-License-Identifier: LGPL-3.0-or-later
"""The program `locus` from outside: what it refuses and how, and whether its results say what doc/ promises.

Run by ctest; by hand: LOCUS_BIN_DIR=build/bin python3 test/cli_test.py
The points of each result are checked against the input curves, evaluated here from the definition in rationals.
"""

import copy
import glob
import json
import math
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from fractions import Fraction

ROOT = os.environ.get("LOCUS_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BIN = os.environ.get("LOCUS_BIN_DIR") or os.path.join(ROOT, "build", "bin")
PROGRAM = os.path.join(BIN, "locus")
SMALL_STACK = 256 << 10
PATIENCE = 30  # seconds for one run

failures = []
checks = 0


def check(ok, what):
    global checks
    checks += 1
    if not ok:
        failures.append(what)
    return ok


def run(arguments, stdin=b"", stack=None):
    def limit():
        if stack:
            resource.setrlimit(resource.RLIMIT_STACK, (stack, resource.getrlimit(resource.RLIMIT_STACK)[1]))

    try:
        return subprocess.run([PROGRAM] + arguments, input=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              preexec_fn=limit, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired as e:
        return subprocess.CompletedProcess(e.cmd, "timeout", b"", b"no answer in %d s\n" % PATIENCE)


# ------------------------------------------------------------------------------------------------- what is refused

CUBIC = {"curve": {"degree": 3, "control_points": [[0, 0], [1, 2], [2, -1], [3, 1]]}}
LINE = {"curve": {"degree": 1, "control_points": [[0, 4], [3, 5]]}}
SPLINE = {"curve": {"degree": 2, "control_points": [[0, 0], [1, 2], [2, -1], [3, 1]], "knots": [0, 0, 0, 1, 2, 2, 2]}}
SPACE = {"curve": {"degree": 1, "control_points": [[0, 0, 0], [1, 1, 1]]}}
POINT = {"point": [1, 2, "1/3"]}
PLANE = {"surface": {"degrees": [1, 1], "control_points": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]}}
BASE = {"compute": "bisector", "inputs": [CUBIC, LINE], "options": {"trimmed": False}}
TEXT = json.dumps(BASE)


def job(*changes, base=BASE):
    """A job with some members replaced: (path, value) sets, (path,) deletes."""
    j = copy.deepcopy(base)
    for path, *value in changes:
        at = j
        for key in path[:-1]:
            at = at[key]
        if value:
            at[path[-1]] = value[0]
        else:
            del at[path[-1]]
    return json.dumps(j)


def surface(points, **members):
    """A point in space and a bilinear surface."""
    return job((("inputs",), [POINT, {"surface": dict({"degrees": [1, 1], "control_points": points}, **members)}]))


SQUARE = PLANE["surface"]["control_points"]


def curve(*path):
    return ("inputs", 1, "curve") + path


def spline(**members):
    return job((("inputs", 1), {"curve": dict(SPLINE["curve"], **members)}))


def point_with(text):
    return TEXT.replace("[3, 5]", text)


POINTS = curve("control_points")
# name, text, words that the line must hold
INVALID = [
    ("empty", "", ["empty"]),
    ("white space", " \n\t ", ["empty"]),
    ("no JSON", "hello", ["not JSON", "line 1, column 1"]),
    ("truncated", TEXT[: len(TEXT) // 2], ["not JSON", "inputs[0].curve.control_points"]),
    ("truncated at the end", TEXT[:-1], ["not JSON"]),
    ("text after the end", TEXT + "}", ["not JSON"]),
    ("two documents", TEXT + TEXT, ["not JSON"]),
    ("comma at the end of a list", TEXT.replace("[3, 5]", "[3, 5,]"), ["not JSON", "inputs[1].curve.control_points[1]"]),
    ("single quotes", TEXT.replace('"', "'"), ["not JSON"]),
    ("comment", "// a job\n" + TEXT, ["not JSON"]),
    ("nested lists", "[" * 100000, ["nested"]),
    ("nested lists, closed", "[" * 100000 + "]" * 100000, ["nested"]),
    ("nested objects", '{"inputs":' * 100000, ["nested"]),
    ("nested in a point", point_with("[3, " + "[" * 100000), ["nested", "inputs[1].curve.control_points"]),
    ("NUL bytes", "\0" * 100, ["not JSON"]),
    ("line break in a string", TEXT.replace("bisector", "bi\nsector"), ["not JSON"]),
    ("list", "[]", ["must be an object"]),
    ("number", "17", ["must be an object"]),
    ("null", "null", ["must be an object"]),
    ("NaN", point_with("[3, NaN]"), ["inputs[1].curve.control_points[1][1]", "not JSON"]),
    ("Infinity", point_with("[-Infinity, 5]"), ["inputs[1].curve.control_points[1][0]", "not JSON"]),
    ("enormous number", point_with("[3, 1e999999]"), ["inputs[1].curve.control_points[1][1]", "1e999999"]),
    ("number past the exponents", point_with("[3, 1e4900]"), ["inputs[1].curve.control_points[1][1]", "4000"]),
    ("tiny number", point_with("[3, 1e-999999]"), ["inputs[1].curve.control_points[1][1]", "4000"]),
    ("very long number", point_with("[3, " + "7" * 100000 + "]"), ["inputs[1].curve.control_points[1][1]", "100000 characters"]),
    ("very long fraction", point_with('[3, "1/' + "7" * 100000 + '"]'), ["inputs[1].curve.control_points[1][1]", "characters"]),
    ("leading zero", point_with("[3, 05]"), ["not JSON"]),
    ("hexadecimal", point_with("[3, 0x10]"), ["not JSON"]),
    ("word for a number", point_with('[3, "five"]'), ["inputs[1].curve.control_points[1][1]", "five"]),
    ("empty string for a number", point_with('[3, ""]'), ["inputs[1].curve.control_points[1][1]", "not a number"]),
    ("nan as a string", point_with('[3, "nan"]'), ["inputs[1].curve.control_points[1][1]", "nan"]),
    ("inf as a string", point_with('[3, "inf"]'), ["inputs[1].curve.control_points[1][1]", "inf"]),
    ("fraction of decimals", point_with('[3, "0.5/2"]'), ["inputs[1].curve.control_points[1][1]", "0.5/2"]),
    ("denominator zero", point_with('[3, "1/0"]'), ["inputs[1].curve.control_points[1][1]", "zero"]),
    ("space in a number", point_with('[3, " 5"]'), ["inputs[1].curve.control_points[1][1]"]),
    ("true for a number", point_with("[3, true]"), ["inputs[1].curve.control_points[1][1]", "must be a number"]),
    ("null for a number", point_with("[3, null]"), ["inputs[1].curve.control_points[1][1]", "must be a number"]),
    ("list for a number", point_with("[3, [5]]"), ["inputs[1].curve.control_points[1][1]", "must be a number"]),
    ("duplicate key", TEXT.replace('"compute"', '"compute": "bisector", "compute"', 1), ["compute", "twice"]),
    ("duplicate key inside", TEXT.replace('"degree": 1', '"degree": 1, "degree": 1'), ["inputs[1].curve", "degree", "twice"]),
    ("many keys", "{" + ",".join('"k%d":0' % i for i in range(100000)) + "}", ["keys"]),
    ("unknown key", job((("input",), [])), ['"input"', 'did you mean "inputs"']),
    ("unknown key of an input", job((("inputs", 1, "weight"), [1])), ["inputs[1]", '"weight"']),
    ("unknown key of a curve", job((curve("weigths"), [1, 1])), ["inputs[1].curve", '"weigths"', 'did you mean "weights"']),
    ("another name for points", job((curve("ctrl"), [])), ["inputs[1].curve", '"ctrl"']),
    ("unknown option", job((("options", "tolerence"), 1e-3)), ["options", '"tolerence"', 'did you mean "tolerance"']),
    ("alpha for a bisector", job((("alpha",), "1/3")), ['"alpha"']),
    ("evil key", job((("x\n\x1b[31m\u2028y",), 1)), ["unknown key"]),
    ("no compute", job((("compute",),)), ['"compute"', "missing"]),
    ("unknown compute", job((("compute",), "bisektor")), ["compute", "bisektor", 'did you mean "bisector"']),
    ("compute of a wrong type", job((("compute",), ["bisector"])), ["compute", "must be a string"]),
    ("no inputs key", job((("inputs",),)), ['"inputs"', "missing"]),
    ("no inputs", job((("inputs",), [])), ["inputs", "0 inputs"]),
    ("three inputs", job((("inputs",), [CUBIC, LINE, LINE])), ["inputs", "3 inputs"]),
    ("inputs of a wrong type", job((("inputs",), CUBIC)), ["inputs", "must be a list"]),
    ("input of a wrong type", job((("inputs", 1), [[0, 0], [1, 1]])), ["inputs[1]", "must be an object"]),
    ("empty input", job((("inputs", 1), {})), ["inputs[1]"]),
    ("two things in one input", job((("inputs", 1, "point"), [0, 0])), ["inputs[1]", "one thing"]),
    ("curve of a wrong type", job((("inputs", 1, "curve"), 7)), ["inputs[1].curve", "must be an object"]),
    ("no degree", job((curve("degree"),)), ["inputs[1].curve", '"degree"', "missing"]),
    ("no control points key", job((POINTS,)), ["inputs[1].curve", '"control_points"', "missing"]),
    ("degree too high", job((curve("degree"), 2)), ["inputs[1].curve.control_points", "2 control points for degree 2"]),
    ("degree too low", job((("inputs", 0, "curve", "degree"), 2)), ["inputs[0].curve.control_points", "4 control points for degree 2"]),
    ("degree zero", job((curve("degree"), 0), (POINTS, [[0, 0]])), ["inputs[1].curve.degree"]),
    ("negative degree", job((curve("degree"), -1)), ["inputs[1].curve.degree"]),
    ("broken degree", job((curve("degree"), 1.5)), ["inputs[1].curve.degree", "whole number"]),
    ("enormous degree", job((curve("degree"), 10**30)), ["inputs[1].curve.degree"]),
    ("no control points", job((POINTS, [])), ["inputs[1].curve.control_points", "0 control points"]),
    ("one control point", job((POINTS, [[0, 0]])), ["inputs[1].curve.control_points", "1 control points"]),
    ("flat control points", job((POINTS, [0, 0, 1, 1])), ["inputs[1].curve.control_points[0]", "must be a list"]),
    ("point of one coordinate", point_with("[3]"), ["inputs[1].curve.control_points[1]", "not 1"]),
    ("point of four coordinates", point_with("[3, 5, 0, 1]"), ["inputs[1].curve.control_points[1]", "not 4"]),
    ("mixed dimensions in a curve", point_with("[3, 5, 0]"), ["inputs[1].curve.control_points[1]", "inputs[0].curve.control_points[0]"]),
    ("mixed dimensions", job((("inputs", 1), SPACE)), ["inputs[1].curve.control_points[0]", "3 coordinates"]),
    ("mixed dimensions with a point", job((("inputs", 1), {"point": [1, 2, 3]})), ["inputs[1].point"]),
    ("one point repeated", job((POINTS, [[1, 2], [1, 2]])), ["inputs[1].curve.control_points", "single point"]),
    ("too few weights", job((curve("weights"), [1])), ["inputs[1].curve.weights", "1 weights for 2"]),
    ("zero weights", job((curve("weights"), [0, 0])), ["inputs[1].curve.weights", "zero"]),
    ("pole inside", job((curve("weights"), [1, -1])), ["inputs[1].curve.weights", "pole"]),
    ("one point after reduction", job((curve("weights"), [1, 0])), ["inputs[1].curve", "single point"]),
    ("double pole", job((("inputs", 1), {"curve": {"degree": 2, "control_points": [[0, 0], [1, 1], [2, 0]], "weights": [1, -1, 1]}})), ["inputs[1].curve.weights", "pole"]),
    ("weight that is no number", job((curve("weights"), [1, "w"])), ["inputs[1].curve.weights[1]"]),
    ("one point but for its weights", job((POINTS, [[1, 2], [1, 2]]), (curve("weights"), [1, 2])), ["single point"]),
    ("closed that is open", job((curve("closed"), True)), ["inputs[1].curve.closed", "coincide"]),
    ("closed of a wrong type", job((curve("closed"), "yes")), ["inputs[1].curve.closed", "true or false"]),
    ("too few knots", spline(knots=[0, 0, 0, 2, 2, 2]), ["inputs[1].curve.knots", "6 knots"]),
    ("knots that decrease", spline(knots=[0, 0, 0, 3, 2, 2, 2]), ["inputs[1].curve.knots[4]", "decrease"]),
    ("knots in one place", spline(knots=[1] * 7), ["inputs[1].curve.knots"]),
    ("inner knot too often", spline(control_points=[[0, 0], [1, 2], [2, -1], [3, 1], [4, 4], [5, 5]], knots=[0, 0, 0, 1, 1, 1, 2, 2, 2]), ["inputs[1].curve.knots", "repeated"]),
    ("pole of a spline", spline(weights=[1, -3, -3, 1]), ["inputs[1].curve.weights", "pole"]),
    ("spline that is one point", spline(control_points=[[1, 1]] * 4), ["inputs[1].curve.control_points", "single point"]),
    ("closed spline that is open", spline(closed=True), ["inputs[1].curve.closed"]),
    ("spline that jumps where points differ", spline(degree=1, knots=[0, 0, 1, 1, 2, 2]), ["inputs[1].curve.knots[3]", "jumps"]),
    ("spline that stands still", spline(control_points=[[0, 0], [1, 2], [1, 2], [3, 1]], degree=1, knots=[0, 0, 1, 2, 3, 3]), ["inputs[1].curve.control_points", "stands still", "knots[2]"]),
    ("closed line", job((("inputs", 1), {"curve": {"monomial": {"x": [0, 1], "y": [1]}, "domain": ["-inf", "inf"], "closed": True}})), ["inputs[1].curve.closed", "infinity"]),
    ("domain without monomials", job((curve("domain"), [0, 1])), ["inputs[1].curve", "domain"]),
    ("monomials and control points", job((curve("monomial"), {"x": [0, 1], "y": [1]})), ["inputs[1].curve", "exclude"]),
    ("monomials without y", job((("inputs", 1), {"curve": {"monomial": {"x": [0, 1]}, "domain": [0, 1]}})), ["inputs[1].curve.monomial", '"y"']),
    ("monomials without domain", job((("inputs", 1), {"curve": {"monomial": {"x": [0, 1], "y": [1]}}})), ["inputs[1].curve", '"domain"']),
    ("empty domain", job((("inputs", 1), {"curve": {"monomial": {"x": [0, 1], "y": [1]}, "domain": [1, 1]}})), ["inputs[1].curve.domain", "empty"]),
    ("domain upside down", job((("inputs", 1), {"curve": {"monomial": {"x": [0, 1], "y": [1]}, "domain": ["inf", "-inf"]}})), ["inputs[1].curve.domain[0]"]),
    ("monomials of one point", job((("inputs", 1), {"curve": {"monomial": {"x": [1, 2], "y": [3, 6], "w": [1, 2]}, "domain": [0, 1]}})), ["inputs[1].curve.monomial", "single point"]),
    ("monomials over zero", job((("inputs", 1), {"curve": {"monomial": {"x": [1, 2], "y": [3, 6], "w": [0, 0]}, "domain": [0, 1]}})), ["inputs[1].curve.monomial.w", "zero"]),
    ("surface of planar points", job((("inputs",), [{"surface": {"degrees": [1, 1], "control_points": [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]}}, LINE])), ["inputs[0].surface.control_points[0][0]"]),
    ("ragged surface", job((("inputs",), [{"surface": {"degrees": [1, 1], "control_points": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0]]]}}, SPACE])), ["inputs[0].surface.control_points[1]"]),
    ("pole of a surface", surface(SQUARE, weights=[[1, 1], [1, -1]]), ["inputs[1].surface.weights", "pole"]),
    ("pole of a surface at its corner", surface(SQUARE, weights=[[1, 1], [1, 0]]), ["inputs[1].surface.weights", "pole", "(1.000000, 1.000000)"]),
    ("surface over zero", surface(SQUARE, weights=[[0, 0], [0, 0]]), ["inputs[1].surface.weights", "zero"]),
    ("too few weights of a surface", surface(SQUARE, weights=[[1, 1], [1]]), ["inputs[1].surface.weights[1]", "1 weights"]),
    ("too few knots of a surface", surface(SQUARE, knots=[[0, 0, 1, 1], [0, 1, 1]]), ["inputs[1].surface.knots[1]", "3 knots"]),
    ("surface that is a curve", surface([[[0, 0, 0], [0, 0, 0]], [[1, 0, 2], [1, 0, 2]]]), ["inputs[1].surface.control_points", "is a curve"]),
    ("surface that is a line", surface([[[0, 0, 0], [1, 0, 0]], [[2, 0, 0], [3, 0, 0]]]), ["inputs[1].surface.control_points", "is a curve"]),
    ("surface that is one point", surface([[[1, 0, 0], [1, 0, 0]], [[1, 0, 0], [1, 0, 0]]]), ["inputs[1].surface.control_points", "single point"]),
    ("one point twice", job((("inputs",), [POINT, {"point": [1, "4/2", "3/9"]}])), ["inputs[1]", "same", "different points"]),
    ("pole of a curve in space", job((("inputs",), [POINT, {"curve": {"degree": 1, "control_points": [[0, 0, 0], [1, 1, 1]], "weights": [1, -1]}}])), ["inputs[1].curve.weights", "pole"]),
    ("one surface alone", job((("inputs",), [PLANE])), ["inputs[0]", "self-bisector"]),
    ("curvature of a point", job((("compute",), "curvature"), (("inputs",), [POINT])), ["inputs[0]", "takes a curve"]),
    ("evolute of a surface", job((("compute",), "evolute"), (("inputs",), [PLANE])), ["inputs[0]", "takes a curve"]),
    ("evolute of two curves", job((("compute",), "evolute"), (("inputs",), [SPACE, SPACE])), ["inputs", "2 inputs"]),
    ("point alone", job((("inputs",), [{"point": [0, 0]}])), ["inputs[0]", "self-bisector"]),
    ("envelope of a point", job((("compute",), "envelope"), (("inputs", 1), {"point": [0, 0]})), ["inputs", "envelope"]),
    ("curvature of two curves", job((("compute",), "curvature")), ["inputs", "2 inputs"]),
    ("alpha sector without alpha", job((("compute",), "alpha_sector")), ['"alpha"', "missing"]),
    ("alpha of one", job((("compute",), "alpha_sector"), (("alpha",), 1)), ["alpha", "between 0 and 1"]),
    ("options of a wrong type", job((("options",), [])), ["options", "must be an object"]),
    ("trimmed of a wrong type", job((("options", "trimmed"), 0)), ["options.trimmed", "true or false"]),
    ("tolerance zero", job((("options", "tolerance"), 0)), ["options.tolerance", "positive"]),
    ("negative tolerance", job((("options", "tolerance"), -1e-6)), ["options.tolerance", "positive"]),
    ("tolerance of a wrong type", job((("options", "tolerance"), {})), ["options.tolerance", "must be a number"]),
    ("negative join tolerance", job((("options", "join_tolerance"), -1)), ["options.join_tolerance"]),
    # Invalid and asking for what is missing: invalid comes first.
    ("trimmed, and an unknown key", job((("options",), {"trimmed": True, "zoom": 1})), ["options", '"zoom"']),
    ("a point, and a wrong curve", job((("inputs", 0), {"point": [0, 0]}), (curve("weights"), [1, -1])), ["inputs[1].curve.weights"]),
    ("a spline, and a wrong tolerance", spline().replace('"trimmed": false', '"tolerance": "0"'), ["options.tolerance"]),
]

# name, text, words
MISSING = [
    ("one curve in space", job((("inputs",), [SPACE])), ["inputs[0]", "self-bisector", "space"]),
    ("one curve in space, trimmed", job((("inputs",), [SPACE]), (("options",),)), ["inputs[0]", "self-bisector", "space"]),
    ("curves in space, trimmed", job((("inputs",), [SPACE, SPACE]), (("options", "trimmed"), True)), ["options.trimmed"]),
    ("curves in space, trimmed by default", job((("inputs",), [SPACE, SPACE]), (("options",),)), ["options.trimmed"]),
    ("point and curve in space, trimmed", job((("inputs",), [POINT, SPACE]), (("options",),)), ["options.trimmed"]),
    ("point and surface, trimmed", job((("inputs",), [PLANE, POINT]), (("options",),)), ["options.trimmed"]),
    ("curve and surface", job((("inputs",), [SPACE, PLANE])), ["inputs[0]", "curve in space and a surface"]),
    ("surface and curve", job((("inputs",), [PLANE, SPACE])), ["inputs[0]", "curve in space and a surface"]),
    ("surfaces", job((("inputs",), [PLANE, PLANE])), ["inputs[0]", "surface"]),
    ("curves in a plane across all axes", job((("inputs",), [{"curve": {"degree": 2, "control_points": [[0, 0, 0], [1, 0, 0], [0, 1, 1]]}}, SPACE])), ["plane", "irrational length"]),
    ("alpha sector", job((("compute",), "alpha_sector"), (("alpha",), "1/3")), ["alpha_sector"]),
    ("envelope", job((("compute",), "envelope")), ["envelope"]),
    ("silhouette", json.dumps({"compute": "silhouette", "inputs": [PLANE], "eye": [0, 0, 1]}), ["silhouette"]),
    ("sweep", json.dumps({"compute": "sweep", "inputs": [PLANE], "motion": {}}), ["sweep"]),
    ("high degree", job((("inputs", 1), {"curve": {"degree": 500, "control_points": [[i, i * i] for i in range(501)]}})), ["inputs[1]", "degree"]),
    ("surface of high degree", job((("inputs",), [POINT, {"surface": {"degrees": [500, 1], "control_points": [[[i, i * i, 0], [i, 0, 1]] for i in range(501)]}}])), ["inputs[1]", "surfaces of degree"]),
    ("irrational cusp", job((("inputs", 1), {"curve": {"monomial": {"x": [0, "-1/2", 0, "1/3"], "y": [0, 0, "-1/4", 0, "1/4"]}, "domain": [0, 1]}})), ["cusp"]),
    ("irrational pole", job((("inputs", 1), {"curve": {"monomial": {"x": [1], "y": [0, 1], "w": [-2, 0, 1]}, "domain": [0, "inf"]}})), ["inputs[1]", "pole", "1.41421"]),
]


def check_refusal(name, result, status, words):
    error = result.stderr.decode("utf-8", "replace")
    check(result.returncode == status, f"{name}: status {result.returncode}, not {status}: {error[:300]!r}")
    check(result.stdout == b"", f"{name}: wrote {result.stdout[:80]!r} to standard output")
    check(error.endswith("\n") and len(error.splitlines()) == 1, f"{name}: not one line: {error[:300]!r}")
    check("\x1b" not in error and len(error) < 3000, f"{name}: unfit for a terminal: {error[:300]!r}")
    if status == 2:
        check(error.startswith("locus: ") and "; " in error, f"{name}: no remedy: {error[:300]!r}")
    for word in words:
        check(word in error, f"{name}: {word!r} is not in {error[:300]!r}")


def test_refusals(folder):
    path = os.path.join(folder, "job.json")
    for table, status in ((INVALID, 2), (MISSING, 4)):
        for name, text, words in table:
            with open(path, "wb") as f:
                f.write(text.encode("utf-8", "surrogatepass"))
            check_refusal(name, run([path], stack=SMALL_STACK), status, ["job.json"] + words)
    # Bytes that are no text.
    for name, data in [("UTF-16", TEXT.encode("utf-16")), ("Latin 1", TEXT.replace("bisector", "bis\xe9ctor").encode("latin-1")),
                       ("a broken sequence", TEXT.encode().replace(b"bisector", b"bi\xf0\x28\x8c\x28")),
                       ("random bytes", bytes(range(256)) * 40)]:
        with open(path, "wb") as f:
            f.write(data)
        check_refusal(name, run([path], stack=SMALL_STACK), 2, ["not JSON"])
    with open(path, "wb") as f:
        f.write(b'{"compute": "' + b"x" * (65 << 20) + b'"}')
    check_refusal("a large file", run([path], stack=SMALL_STACK), 2, ["64 MiB"])
    with open(path, "wb") as f:
        f.write(b'{"inputs": [' + b"0," * (10 << 20) + b"0]}")
    check_refusal("many values", run([path], stack=SMALL_STACK), 2, ["values"])
    check_refusal("many values on standard input", run(["-"], stdin=b"[" + b"[]," * 3000000), 2, ["standard input", "values"])
    check_refusal("standard input", run(["-"], stdin=b"{"), 2, ["standard input", "not JSON"])


def test_command_line(folder):
    path = os.path.join(folder, "job.json")
    with open(path, "w") as f:
        f.write(TEXT)
    out = os.path.join(folder, "out.json")
    for name, arguments, words in [
        ("no job", [], ["JOB"]), ("unknown option", [path, "--jsn", out], ["--jsn"]), ("two jobs", [path, path], []),
        ("no such job", [os.path.join(folder, "absent.json")], ["absent.json", "cannot be read"]),
        ("a folder for a job", [folder], ["directory"]), ("an option without its value", [path, "--json"], ["--json"]),
        ("tolerance of zero", [path, "--tolerance", "0"], ["--tolerance", "positive"]),
        ("negative tolerance", [path, "--tolerance=-1e-6"], ["--tolerance", "positive"]),
        ("tolerance nan", [path, "--tolerance", "nan"], ["--tolerance", "nan"]),
        ("cells that are no number", [path, "--max-cells", "few"], ["max-cells"]),
        ("negative cells", [path, "--max-cells", "-5"], ["max-cells"]),
        ("seconds nan", [path, "--max-seconds", "nan"], ["max-seconds"]),
        ("one file for two", [path, "--json", out, "--svg", out], ["two outputs"]),
        ("the job overwritten", [path, "--json", path], ["is the job itself"]),
        ("no folder for the result", [path, "--json", os.path.join(folder, "absent", "out.json")], ["cannot be written"]),
        ("no folder for the picture", [path, "--json", out, "--svg", os.path.join(folder, "absent", "out.svg")], ["cannot be written"]),
        ("check without a certificate", ["check"], ["CERTIFICATE"]),
    ]:
        check_refusal(name, run(arguments), 2, words)
    check_refusal("two meshes in one file", run([path, "--json", out, "--obj", out]), 2, ["out.json", "two outputs"])
    for option in ("--ply", "--obj", "--vtk"):
        check_refusal(f"{option} in the plane", run([path, option, out]), 4, [option, "mesh"])
    for name, text, option in [("in space", job((("inputs",), [POINT, SPACE])), "--svg"), ("in space", job((("inputs",), [POINT, SPACE])), "--certificate"),
                               ("of curvature in space", job((("compute",), "curvature"), (("inputs",), [SPACE])), "--svg"),
                               ("of an evolute in space", job((("compute",), "evolute"), (("inputs",), [SPACE])), "--ply"),
                               ("of curvature", job((("compute",), "curvature"), (("inputs",), [CUBIC])), "--certificate"),
                               ("of an evolute", job((("compute",), "evolute"), (("inputs",), [CUBIC])), "--certificate"),
                               ("of curvature", job((("compute",), "curvature"), (("inputs",), [CUBIC])), "--ply")]:
        check_refusal(f"{option} {name}", run(["-", option, path + ".out"], stdin=text.encode()), 4, [option])
    check(not os.path.exists(path + ".out"), "a refused job wrote its output")
    check_refusal("a job for a certificate", run(["check", path]), 2, ["certificate"])
    check_refusal("no certificate", run(["check", os.path.join(folder, "absent.json")]), 2, ["absent.json"])
    with open(path) as f:
        check(f.read() == TEXT, "the job was overwritten")
    if os.path.exists("/dev/full"):
        check_refusal("a full disk", run([path, "--json", "/dev/full"]), 2, ["/dev/full", "cannot be written"])
    for option in ("--help", "--version"):
        result = run([option])
        check(result.returncode == 0 and result.stderr == b"" and b"locus" in result.stdout, f"{option}: {result}")

    plain, piped = run([path]), run(["-"], stdin=TEXT.encode())
    without_time = [b"\n".join(line for line in r.stdout.splitlines() if b'"seconds"' not in line) for r in (plain, piped)]
    check(plain.returncode == 0 and plain.stderr == b"" and without_time[0] == without_time[1], "standard input and a file differ")
    result = run([path, "--svg", "-"])
    check(result.returncode == 0 and result.stdout.startswith(b"<svg"), "--svg - does not write the picture")
    result = run([path, "--json", out, "--progress"])
    check(result.returncode == 0 and result.stdout == b"", "--json OUT writes to standard output too")
    result = run([path, "--max-cells", "1"])
    check(result.returncode == 1, f"one cell was enough: {result.returncode} {result.stderr!r}")
    data = read_result(result.stdout)
    check(data["status"] == "undecided" and data["undecided"], "a limit was reached, but nothing is undecided")
    sizes = [len(read_result(run([path, "--tolerance", e]).stdout)["arcs"][0]["samples"]) for e in ("1/100", "1e-4", "1e-8")]
    check(sizes[0] < sizes[1] < sizes[2], f"--tolerance does not change the number of samples: {sizes}")


# --------------------------------------------------------------------------------------------------------- results


def reject_constant(name):
    raise ValueError(f"{name} is not JSON")


def read_result(text):
    return json.loads(text, parse_constant=reject_constant)


def exact(number):
    return Fraction(number)  # an int, a Fraction, or a string like "2/3" or "0.25"


def parameter(x):
    """A parameter of a result: a number, or "inf" or "-inf"."""
    return float(x) if isinstance(x, str) else x


def casteljau(row, s):
    """Value and derivative at s of a Bernstein form."""
    n = len(row) - 1
    if n == 0:
        return row[0], 0 * row[0]
    while len(row) > 2:
        row = [a + s * (b - a) for a, b in zip(row, row[1:])]
    return row[0] + s * (row[1] - row[0]), n * (row[1] - row[0])


def polar_form(row, knots, d, span, arguments):
    """The spline's polar form on the span from knots[span], by its definition."""
    c = row[span - d:span + 1]
    for level, u in enumerate(arguments, 1):
        c = [((knots[span + i + 1] - u) * c[i] + (u - knots[span - d + i + level]) * c[i + 1]) / (knots[span + i + 1] - knots[span - d + i + level])
             for i in range(d + 1 - level)]
    return c[0]


class Control_curve:
    """A Bézier curve or B-spline on its parameter range, from the definition."""

    def __init__(self, data):
        d = data["degree"]
        points = [[exact(x) for x in p] for p in data["control_points"]]
        weights = [exact(w) for w in data.get("weights", [1] * len(points))]
        rows = [[p[k] * w for p, w in zip(points, weights)] for k in range(2)] + [weights]
        knots = [exact(k) for k in data.get("knots", [0] * (d + 1) + [1] * (d + 1))]
        self.origin = points[0]  # floats are seen from there
        self.spans = []
        for i in range(d, len(points)):
            if knots[i] < knots[i + 1]:
                forms = [[polar_form(row, knots, d, i, [knots[i]] * (d - j) + [knots[i + 1]] * j) for j in range(d + 1)] for row in rows]
                rough = [[float(x - o * w) for x, w in zip(row, forms[2])] for row, o in zip(forms, self.origin)] + [list(map(float, forms[2]))]
                self.spans.append((knots[i], knots[i + 1], forms, rough))
        self.lo, self.hi = self.spans[0][0], self.spans[-1][1]
        self.closed = data.get("closed", False)
        self.knots = [span[0] for span in self.spans] + [self.hi]

    def homogeneous(self, u):
        """Of the sides that meet at u: coordinates and weight with their derivatives."""
        u = Fraction(u)
        sides = [(lo, hi, forms) for lo, hi, forms, _ in self.spans if lo <= u <= hi]
        if not sides:  # the rounding of an end
            sides = [self.spans[0 if u < self.lo else -1][:3]]
        if self.closed and u in (self.lo, self.hi):
            other = self.spans[-1 if u == self.lo else 0]
            return [[casteljau(row, s) for row in forms] for s, forms in
                    [((u - sides[0][0]) / (sides[0][1] - sides[0][0]), sides[0][2]), (Fraction(u == self.lo), other[2])]]
        return [[casteljau(row, (u - lo) / (hi - lo)) for row in forms] for lo, hi, forms in sides]

    def rough_values(self, u):
        k = 0
        while k + 1 < len(self.spans) and u > self.spans[k][1]:
            k += 1
        lo, hi, _, rough = self.spans[k]
        return [casteljau(row, (u - float(lo)) / float(hi - lo))[0] for row in rough]


class Monomial_curve:
    """A curve given by powers of u, at infinity seen in v = 1/u."""

    def __init__(self, data):
        rows = [[exact(c) for c in data["monomial"].get(key, [1])] for key in "xyw"]
        n = max(map(len, rows))
        self.rows = [row + [Fraction(0)] * (n - len(row)) for row in rows]
        self.lo, self.hi = (float(x) if x in ("-inf", "inf") else exact(x) for x in data["domain"])
        self.origin = (Fraction(0), Fraction(0))
        self.rough = [list(map(float, row)) for row in self.rows]
        self.closed = data.get("closed", False) or (math.isinf(self.lo) and math.isinf(self.hi) and self.rows[2][-1] != 0)
        self.knots = []  # where it is cut is the library's choice

    @staticmethod
    def horner(row, u):
        value = slope = 0 * u
        for c in reversed(row):
            value, slope = value * u + c, slope * u + value
        return value, slope

    def homogeneous(self, u):
        if abs(u) <= 1:
            return [[self.horner(row, Fraction(u)) for row in self.rows]]
        v = Fraction(0) if math.isinf(u) else 1 / Fraction(u)
        return [[self.horner(row[::-1], v) for row in self.rows]]

    def rough_values(self, u):
        if abs(u) <= 1:
            return [self.horner(row, u)[0] for row in self.rough]
        return [self.horner(row[::-1], 1 / u)[0] for row in self.rough]


class Curve:
    """An input, evaluated exactly at floats, and fast in floats."""

    def __init__(self, data):
        self.form = Monomial_curve(data) if "monomial" in data else Control_curve(data)
        self.lo, self.hi, self.closed = self.form.lo, self.form.hi, self.form.closed
        self.infinite = math.isinf(self.lo) or math.isinf(self.hi)

    def contains(self, lo, hi):
        """In the domain, but for the rounding of its ends to doubles."""
        return lo >= math.nextafter(float(self.lo), -math.inf) and hi <= math.nextafter(float(self.hi), math.inf)

    def fine_enough(self, lo, hi):
        """Is a range of parameters a small part of the domain?"""
        if math.isinf(lo) or math.isinf(hi):
            return lo == hi
        return lo <= hi <= lo + 1e-6 * ((1 + lo * lo) if self.infinite else float(self.hi - self.lo))

    def is_knot(self, lo, hi):
        return isinstance(self.form, Monomial_curve) or any(lo <= k <= hi for k in self.form.knots)

    def same(self, u, v):
        """Are two parameters one place, but for the seam?"""
        if u == v or abs(u - v) <= 1e-9 * (1 + (u * u if self.infinite else float(self.hi - self.lo))):
            return True
        return self.closed and {min(u, v), max(u, v)} == {float(self.lo), float(self.hi)}

    def rough_distance(self, u, point):
        """From a point to the curve's point at u, in floats."""
        x, y, w = self.form.rough_values(u)
        if w == 0:
            return math.inf
        p = [float(Fraction(c) - o) for c, o in zip(point, self.form.origin)]
        return math.hypot(p[0] - x / w, p[1] - y / w)

    def at(self, u):
        """Point and tangent directions, exactly, at a float: of both sides at a knot. No point at infinity."""
        sides = self.form.homogeneous(u)
        (x, _), (y, _), (w, _) = sides[0]
        if w == 0:
            return None, None
        return (x / w, y / w), [(dx * w - x * dw, dy * w - y * dw) for (x, dx), (y, dy), (w, dw) in sides]

    def reverses(self, lo, hi):
        """Does the curve stand still in a narrow range, or turn back? There it is cut."""
        (ax, ay), (bx, by) = self.at(lo)[1][0], self.at(hi)[1][0]
        return ax * bx + ay * by <= 0


KEYS = ["compute", "trimmed", "status", "tolerance", "scale", "cut_radius", "centre", "components", "equations", "vertices", "arcs", "regions", "degenerate",
        "joined_by_tolerance", "undecided", "statistics"]
KINDS = {"boundary", "corner", "infinity", "node", "isolated", "trim", "diagonal", "undecided"}


def check_point(name, curves, scale, parameters, point, radius, slack):
    """A locus point: on the normals of its feet, and at their distance."""
    # Far from the origin doubles are far apart.
    allowed = 1e-9 * max(scale, radius) + slack + 4 * max(map(math.ulp, point))
    for c, u in zip(curves, parameters):
        foot, tangents = c.at(u)
        if foot is None:
            continue
        difference = [float(Fraction(x) - f) for x, f in zip(point, foot)]
        off = math.hypot(*difference) - radius
        if not check(abs(off) <= allowed, f"{name}: {point} is off by {off:.2g} from its foot at {u}"):
            return
        slopes = [slope_along(difference, t) for t in tangents]
        check(min(slopes) <= 1e3 * allowed, f"{name}: {point} is not on the normal at {u} (by {min(slopes):.2g})")


def slope_along(difference, tangent):
    """Length of a vector's part along a tangent; 0 where the curve stands still."""
    size = max(abs(x) for x in tangent)
    if size == 0:
        return 0
    t = [float(x / size) for x in tangent]
    return abs(difference[0] * t[0] + difference[1] * t[1]) / math.hypot(*t)


def components(data):
    parent = list(range(len(data["vertices"])))

    def find(i):
        while parent[i] != i:
            i = parent[i]
        return i

    used, closed = set(), 0
    for arc in data["arcs"]:
        if arc["closed"]:
            closed += 1
        else:
            used |= {arc["source"], arc["target"]}
            parent[find(arc["source"])] = find(arc["target"])
    used |= {i for i, v in enumerate(data["vertices"]) if v["kind"] == "isolated"}
    return closed + len({find(i) for i in used})


def curves_of(job_text):
    """Both curves of the pair: one curve alone is paired with itself. With the inputs' numbers."""
    inputs = json.loads(job_text, parse_float=Fraction)["inputs"]
    curves = [Curve(i["curve"]) for i in inputs]
    return (curves, [0, 1]) if len(curves) == 2 else (curves * 2, [0, 0])


def check_result(name, job_text, data):
    curves, inputs = curves_of(job_text)
    check(list(data) == KEYS, f"{name}: keys {list(data)}")
    check(data["compute"] == "bisector" and data["trimmed"] is False, f"{name}: another job's result")
    check((data["status"] == "certified") == (data["undecided"] == []), f"{name}: status and undecided boxes disagree")
    scale, cut = data["scale"], data["cut_radius"]
    check(cut >= 10 * scale > 0, f"{name}: cut_radius {cut}, scale {scale}")
    check(all(e["name"] and len(e["degrees"]) == 2 for e in data["equations"]), f"{name}: equations")
    for key in ("cells", "filter_calls", "filter_failures", "exact_cells"):
        check(isinstance(data["statistics"][key], int), f"{name}: statistics.{key}")
    check(data["statistics"]["seconds"] >= 0, f"{name}: statistics.seconds")
    check(data["components"] == components(data), f"{name}: components")
    for i, v in enumerate(data["vertices"]):
        check_vertex(f"{name}: vertices[{i}]", i, v, data, curves, inputs)
    for i, arc in enumerate(data["arcs"]):
        check_arc(f"{name}: arcs[{i}]", arc, data, curves, inputs)
    for i, d in enumerate(data["degenerate"]):
        check(d["kind"] in ("centre", "infinity", "overlap", "everything") and d["reason"], f"{name}: degenerate[{i}]")
        check_box(f"{name}: degenerate[{i}]", d["box"], curves)
    for i, u in enumerate(data["undecided"]):
        check(u["reason"], f"{name}: undecided[{i}]")
        check_box(f"{name}: undecided[{i}]", u["box"], curves)


def check_box(where, box, curves):
    check(len(box) == 2, f"{where}: box {box}")
    for c, r in zip(curves, box):
        lo, hi = map(parameter, r)
        check(lo <= hi and c.contains(lo, hi), f"{where}: box {box}")


def check_vertex(where, i, v, data, curves, inputs):
    check(v["kind"] in KINDS, f"{where}: kind {v['kind']}")
    check([f["input"] for f in v["feet"]] == inputs, f"{where}: feet {v['feet']}")
    ranges, features = [], [f["feature"] for f in v["feet"]]
    for c, foot in zip(curves, v["feet"]):
        [[lo, hi]] = foot["parameters"]
        lo, hi = parameter(lo), parameter(hi)
        ranges.append((lo, hi))
        check(lo <= hi and c.fine_enough(lo, hi) and c.contains(lo, hi), f"{where}: parameters [{lo}, {hi}]")
        check_feature(where, c, foot["feature"], lo, hi)
    middle = [lo if lo == hi else lo + (hi - lo) / 2 for lo, hi in ranges]
    at_infinity = any(c.at(u)[0] is None for c, u in zip(curves, middle))
    if v["kind"] == "boundary":  # where a tangent turns, though by less than the tolerance, arcs may end as well
        check(set(features) != {"interior"} or data["joined_by_tolerance"], f"{where}: a boundary vertex inside")
    if v["kind"] == "corner":
        check("corner" in features, f"{where}: a corner without one")
    if v["kind"] == "diagonal":
        (lo, hi), (lo2, hi2) = ranges
        across_seam = curves[0].closed and hi >= curves[0].hi and lo2 <= curves[0].lo
        check(inputs == [0, 0] and (max(lo, lo2) <= min(hi, hi2) or across_seam), f"{where}: not on the diagonal: {ranges}")
    if v["kind"] == "infinity":
        check("point" not in v and abs(math.hypot(*v["direction"]) - 1) < 1e-12, f"{where}: {v}")
        check(at_infinity or set(v["asymptote"]) == {"point", "direction"}, f"{where}: asymptote")
    else:
        width = max(hi - lo for lo, hi in ranges if lo < hi) if any(lo < hi for lo, hi in ranges) else 0
        if "point" in v:
            check_point(where, curves, data["scale"], middle, v["point"], v["radius"], 1e3 * data["scale"] * width)
        else:  # where the curves touch, the position is 0/0: the result must say so
            check(any("0/0" in u["reason"] for u in data["undecided"]), f"{where}: no point, and nothing said of it")
    ends = [(a, at) for a, arc in enumerate(data["arcs"]) for at in ("source", "target") if arc.get(at) == i]
    if v["kind"] == "node":
        named = [(h["arc"], h["at"]) for h in v["half_branches"]]
        least = 4 if all(f == "interior" for f in features) else 1  # on the domain's boundary part of it is cut off
        check(sorted(named) == sorted(ends) and len(ends) >= least, f"{where}: half-branches {named}, arc ends {ends}")
        if not any(map(math.isinf, middle)):
            check_cyclic_order(where, data, middle, named)
    check((ends == []) == (v["kind"] == "isolated"), f"{where}: {v['kind']} with the arc ends {ends}")


def check_feature(where, c, feature, lo, hi):
    check(feature in ("interior", "start", "end", "corner"), f"{where}: feature {feature}")
    if feature == "corner":
        check(c.is_knot(lo, hi) or c.reverses(lo, hi), f"{where}: a corner inside a span, at [{lo}, {hi}]")
    elif feature != "interior":
        end = c.lo if feature == "start" else c.hi
        check(lo <= end <= hi and (hi == lo or hi == math.nextafter(lo, math.inf)), f"{where}: {feature} at [{lo}, {hi}]")
        check(not c.closed, f"{where}: the end of a closed curve")


def check_cyclic_order(where, data, middle, named):
    """Directions in which the branches leave a node of the parameter space turn one way, once around."""
    angles = []
    for a, at in named:
        samples = data["arcs"][a]["samples"]
        samples = samples if at == "source" else samples[::-1]
        out = [u for u in map(parameters_of, samples) if 1e-5 < math.dist(u, middle) < math.inf]
        angles.append(math.atan2(out[0][1] - middle[1], out[0][0] - middle[0]))
    turns = [(b - a) % (2 * math.pi) for a, b in zip(angles, angles[1:] + angles[:1])]
    check(abs(sum(turns) - 2 * math.pi) < 1e-6 or abs(sum(2 * math.pi - t for t in turns) - 2 * math.pi) < 1e-6,
          f"{where}: half-branches are not in cyclic order: {angles}")


def parameters_of(sample):
    return [parameter(u) for u in sample["parameters"]]


def check_samples(where, arc, data, curves):
    scale, samples = data["scale"], arc["samples"]
    for s in samples:
        distances = [c.rough_distance(u, s["point"]) for c, u in zip(curves, parameters_of(s))]
        off = max((abs(d - s["radius"]) for d in distances if not math.isinf(d)), default=0)
        if not check(off <= 1e-6 * max(scale, s["radius"]) + 8 * max(map(math.ulp, s["point"])), f"{where}: sample {s} is off by {off:.2g}"):
            break
    every = max(1, len(samples) // 80)
    for s in samples[::every] + samples[-1:] + arc["irregular"]:
        u = parameters_of(s)
        check(len(u) == 2 and all(c.contains(x, x) for c, x in zip(curves, u)), f"{where}: parameters {u}")
        # Near the diagonal the feet meet, and a sample is only as good as the arc's error says.
        check_point(where, curves, scale, u, s["point"], s["radius"], 1e-7 * scale if curves[0] is curves[1] else 0)
    if curves[0] is curves[1]:
        check(all(parameters_of(s)[0] >= parameters_of(s)[1] for s in samples), f"{where}: parameters in the wrong order")


def check_arc(where, arc, data, curves, inputs):
    scale, samples = data["scale"], arc["samples"]
    check(arc["inputs"] == inputs and arc["features"] == ["interior", "interior"], f"{where}: inputs, features")
    check(arc["closed"] == ("source" not in arc) == ("target" not in arc), f"{where}: closed")
    if arc["error"] is None:  # no bound is proved: the result must say so
        check(any("0/0" in u["reason"] for u in data["undecided"]), f"{where}: no error, and nothing said of it")
    else:
        check(isinstance(arc["error"], (int, float)) and 0 <= arc["error"] <= scale, f"{where}: error {arc['error']}")
    check(len(samples) >= 2, f"{where}: {len(samples)} samples")
    if any("0/0" in u["reason"] for u in data["undecided"]):  # near a contact the samples are only as good as the arc's error says
        return
    check_samples(where, arc, data, curves)
    if arc["closed"]:
        check(math.dist(samples[0]["point"], samples[-1]["point"]) <= 1e-9 * scale, f"{where}: does not close")
        return
    for key, sample in (("source", samples[0]), ("target", samples[-1])):
        if not check(isinstance(arc[key], int) and 0 <= arc[key] < len(data["vertices"]), f"{where}: {key} {arc[key]}"):
            continue
        v = data["vertices"][arc[key]]
        if v["kind"] == "infinity":
            check(math.dist(sample["point"], data["centre"]) >= data["cut_radius"] * (1 - 1e-6), f"{where}: cut inside the cut radius")
            continue
        if "point" not in v or arc["error"] is None:
            continue
        if v["kind"] == "node" and v["radius"] == 0 and len(v["half_branches"]) > 4:
            continue  # where the inputs touch, branches tend to different places
        check(math.dist(sample["point"], v["point"]) <= 1e-9 * scale + 4 * math.ulp(v["point"][0]), f"{where}: its {key} is not its vertex")
        check_end(f"{where}: its {key}", parameters_of(sample), v, curves)


def check_end(where, u, v, curves):
    """An arc ends in the parameters of its vertex; those of a self-bisector change places across the seam."""
    at = [parameter(f["parameters"][0][0]) for f in v["feet"]]
    orders = [at, at[::-1]] if curves[0] is curves[1] and curves[0].closed else [at]
    check(any(all(c.same(x, y) for c, x, y in zip(curves, u, order)) for order in orders), f"{where} has the parameters {u}, its vertex {at}")


# -------------------------------------------------------------------------------------------------------- pictures

NUMBER = re.compile(r"-?\d+(\.\d+)?(e-?\d+)?\Z")


def check_picture(name, svg, is_self):
    """Well-formed, every coordinate a finite number, and a self-bisector's square halved by the diagonal."""
    try:
        root = xml.etree.ElementTree.fromstring(svg)
    except xml.etree.ElementTree.ParseError as e:
        check(False, f"{name}: picture: {e}")
        return
    check(root.tag.endswith("svg"), f"{name}: picture")
    diagonals = 0
    for element in root.iter():
        diagonals += element.get("class") == "diagonal"
        for key in ("x", "y", "width", "height", "cx", "cy", "r"):
            check(key not in element.attrib or NUMBER.match(element.get(key)), f"{name}: {key} = {element.get(key)} in its picture")
        words = re.sub(r"([MLHVZhvm])", r" \1 ", element.get("d", "")).split()
        check(all(w in "MLHVZhvm" or (NUMBER.match(w) and abs(float(w)) < 1e5) for w in words), f"{name}: a path of its picture")
    check(diagonals == is_self, f"{name}: {diagonals} diagonals in its picture")


EXPECTED = {  # job: status of the program, arcs, components, kinds of vertices that must be there
    "line_quad": (0, 1, 1, {"boundary"}),
    "parallel_lines": (0, 1, 1, {"boundary"}),
    "concentric_arcs": (0, 1, 1, {"boundary"}),
    "crossing_cubics": (0, None, 1, {"node", "infinity", "boundary"}),
    "mirror_cubics": (0, None, None, {"node"}),
    "node_of_osculating_circles": (0, 4, 1, {"node", "boundary"}),
    "own_parameter_ranges": (0, 1, 1, {"boundary"}),
    "elber_kim_figure_2": (0, 2, 2, {"boundary"}),
    "elber_kim_figure_3": (0, 3, 3, {"boundary"}),
    "elber_kim_figure_4": (0, 5, 5, {"diagonal", "boundary"}),
    "elber_kim_figure_5": (0, 3, 3, {"diagonal", "boundary"}),
    "elber_kim_figure_6": (0, 5, 5, {"boundary"}),
    "elber_kim_figure_7": (0, 3, 3, {"boundary"}),
    "bspline11_line": (0, 2, 2, {"boundary"}),
    "bspline7_self_quad": (0, None, 7, {"diagonal", "boundary", "infinity"}),
    "bspline7_self_cubic": (0, 3, 3, {"diagonal", "boundary"}),
    "closed_cubic_with_itself": (0, 5, 5, {"diagonal"}),
    "ellipse_with_itself": (0, 2, 2, {"diagonal"}),  # both its axes
    "circle_with_itself": (0, 0, 0, set()),
    "nested_ellipses": (0, 2, 2, set()),  # two closed arcs
    "disjoint_ellipses": (0, 4, 2, {"infinity"}),
    "parabola_line": (0, 3, 3, {"boundary"}),
    "hyperbola_cubic": (0, 4, 4, {"boundary"}),
    "line_arc_chain_cubic": (0, 1, 1, {"boundary"}),  # goes on through both G1 knots
    "polyline_cubic": (0, 3, 3, {"corner", "boundary"}),
}


def without_time(text):
    """A result or a picture, but for the time it took."""
    return re.sub(rb'"seconds": [-+.e\d]+', b"", re.sub(rb"[.\d]+(e[-+]\d+)? ms<", b"<", text))


def test_results(folder):
    jobs = sorted(glob.glob(os.path.join(ROOT, "examples", "jobs", "*.json")))
    check(set(EXPECTED) <= {os.path.basename(j)[:-5] for j in jobs}, "a job is gone")
    for path in jobs:
        name = os.path.basename(path)[:-5]
        out, picture = os.path.join(folder, "out.json"), os.path.join(folder, "out.svg")
        files = []
        for _ in range(2):
            result = run([path, "--json", out, "--svg", picture])
            if not check(result.returncode in (0, 1) and result.stderr == b"", f"{name}: status {result.returncode}: {result.stderr[:300]!r}"):
                break
            with open(out, "rb") as f, open(picture, "rb") as g:
                files.append((f.read(), g.read()))
        if len(files) < 2:
            continue
        for (a, b), what in zip(zip(*files), ("result", "picture")):
            check(without_time(a) == without_time(b), f"{name}: a second run gives another {what}")
        with open(path) as f:
            text = f.read()
        data = read_result(files[0][0])
        check(result.returncode == (0 if data["status"] == "certified" else 1), f"{name}: status {result.returncode}, {data['status']}")
        check_result(name, text, data)
        status, arcs, parts, kinds = EXPECTED.get(name, (None, None, None, set()))
        check(status is None or result.returncode == status, f"{name}: status {result.returncode}, not {status}")
        check(arcs is None or len(data["arcs"]) == arcs, f"{name}: {len(data['arcs'])} arcs, not {arcs}")
        check(parts is None or data["components"] == parts, f"{name}: {data['components']} components, not {parts}")
        check(kinds <= {v["kind"] for v in data["vertices"]}, f"{name}: no vertex of {kinds}")
        check_picture(name, files[0][1], len(json.loads(text)["inputs"]) == 1)

    # Numbers are exact: three spellings of one job, one answer; a hair beside it, another.
    def answer(third):
        text = TEXT.replace("[3, 5]", f"[3, {third}]")
        data = read_result(run(["-"], stdin=text.encode()).stdout)
        check_result("spelling " + third, text, data)
        del data["statistics"]
        return data

    check(answer("0.3") == answer('"3/10"') == answer("3e-1") == answer('"0.3"'), "spellings of 0.3 differ")
    # Of every size: the frame keeps doubles from over- and underflow.
    for size in ("1e-300", "1e-100", "1e100", "1e150"):
        c1 = [[0, 0], [1, 2], [3, 0]]
        c2 = [[0, 3], [1, 4], [3, 3]]
        text = '{"compute": "bisector", "inputs": [%s], "options": {"trimmed": false}}' % ", ".join(
            '{"curve": {"degree": 2, "control_points": [%s]}}' % ", ".join(f"[{x}{size[1:]}, {y}{size[1:]}]" for x, y in c) for c in (c1, c2))
        result = run(["-"], stdin=text.encode())
        if check(result.returncode == 0, f"size {size}: status {result.returncode}: {result.stderr[:300]!r}"):
            data = read_result(result.stdout)
            check(len(data["arcs"]) == 1 and data["arcs"][0]["error"] <= 1e-5 * data["scale"], f"size {size}")


def test_curves_of_many_pieces():
    def answer(name, *arguments):
        result = run([os.path.join(ROOT, "examples", "jobs", name + ".json"), *arguments])
        check(result.returncode in (0, 1), f"{name} {arguments}: {result.returncode} {result.stderr!r}")
        return read_result(result.stdout), result.stderr

    circle, _ = answer("circle_with_itself")
    check({d["kind"] for d in circle["degenerate"]} == {"everything"}, f"a circle with itself: {circle['degenerate']}")
    check(sum(d["box"][0] == ["-inf", -1] for d in circle["degenerate"]) == 1, f"a circle's boxes: {circle['degenerate']}")
    check(all(a["closed"] for a in answer("nested_ellipses")[0]["arcs"]), "arcs between nested ellipses do not close")
    joined, _ = answer("joined_by_tolerance")
    check(joined["joined_by_tolerance"] == [{"input": 0, "parameter": 1}, {"input": 0, "parameter": 2}], f"{joined['joined_by_tolerance']}")
    limited, _ = answer("bspline7_self_quad", "--max-cells", "10")
    check(limited["status"] == "undecided" and limited["undecided"], "a limit was reached, but nothing is undecided")
    whole, progress = answer("bspline7_self_quad", "--progress")
    check(whole["status"] == "certified" and re.match(rb"locus: \d+ cells done, \d+ open", progress), f"--progress: {progress[:200]!r}")

    # A line whose perpendicular meets infinity: infinite parameters are strings.
    text = json.dumps({"compute": "bisector", "options": {"trimmed": False}, "inputs": [
        {"curve": {"monomial": {"x": [0, 1], "y": [0]}, "domain": ["-inf", "inf"]}},
        {"curve": {"degree": 2, "control_points": [[-1, 1], [0, 2], [1, 1]]}}]})
    result = run(["-"], stdin=text.encode())
    if check(result.returncode == 0, f"a whole line: {result.returncode} {result.stderr!r}"):
        data = read_result(result.stdout)
        check_result("a whole line", text, data)
        ends = [v["feet"][0]["parameters"] for v in data["vertices"] if v["kind"] == "infinity"]
        check(sorted(ends) == [[["-inf", "-inf"]], [["inf", "inf"]]], f"a whole line: ends at infinity {ends}")


def random_curve(rng):
    """Few digits, so that ties, common factors and symmetries come up."""
    number = rng.choice([lambda: rng.randint(-3, 3), lambda: rng.randint(-8, 8) / 4, lambda: round(rng.uniform(-3, 3), 3)])
    degree = rng.randint(1, 4)
    data = {"degree": degree, "control_points": [[number(), number()] for _ in range(degree + 1)]}
    if rng.random() < 0.4:
        data["weights"] = [rng.choice([1, 1, 2, 3, 0.5]) for _ in range(degree + 1)]
    return {"curve": data}


def random_spline(rng):
    """Of two to five spans; some knots are double, some splines closed."""
    degree = rng.randint(1, 3)
    inner = sorted(rng.choices(range(1, 5), k=rng.randint(1, 4)))
    inner = [k for i, k in enumerate(inner) if inner[:i].count(k) < degree]
    points = [[rng.randint(-8, 8) / 2, rng.randint(-8, 8) / 2] for _ in range(degree + 1 + len(inner))]
    data = {"degree": degree, "control_points": points, "knots": [0] * (degree + 1) + inner + [5] * (degree + 1)}
    if rng.random() < 0.3:
        data["control_points"][-1] = data["control_points"][0]
        data["closed"] = True
    return {"curve": data}


def random_inputs(rng):
    kind = rng.randrange(4)
    if kind < 2:
        return [random_curve(rng), random_curve(rng)]
    return [random_spline(rng)] if kind == 2 else [random_spline(rng), random_curve(rng)]


def test_random_jobs():
    seed = int(os.environ.get("LOCUS_TEST_SEED", "1"))
    answered = 0
    for i in range(100):
        rng = random.Random(1000 * seed + i)
        text = json.dumps({"compute": "bisector", "inputs": random_inputs(rng), "options": {"trimmed": False, "tolerance": 1e-3}})
        result = run(["-"], stdin=text.encode())
        name = f"LOCUS_TEST_SEED={seed}, job {i} {text}"
        # Among so few digits there are curves that are one point (2) and cusps (4).
        if check(result.returncode in (0, 1, 2, 4), f"{name}: status {result.returncode}: {result.stderr[:300]!r}") and result.returncode < 2:
            answered += 1
            check_result(name, text, read_result(result.stdout))
    check(answered >= 80, f"only {answered} of 100 random jobs were answered")


def report():
    """Prints what failed; returns the program's exit status."""
    shown = {}
    for failure in failures:
        about = failure[:60]
        shown[about] = shown.get(about, 0) + 1
        if shown[about] <= 3:
            print("FAILED", failure)
    print(f"{checks} checks, {len(failures)} failed")
    return 1 if failures else 0


def main():
    if not os.access(PROGRAM, os.X_OK):
        print(f"{PROGRAM} is not there: build the target locus_cli first")
        return 1
    with tempfile.TemporaryDirectory() as folder:
        test_refusals(folder)
        test_command_line(folder)
        test_results(folder)
    test_curves_of_many_pieces()
    test_random_jobs()
    return report()


if __name__ == "__main__":
    sys.exit(main())
