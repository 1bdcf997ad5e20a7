# SPDX-License-Identifier: LGPL-3.0-or-later
"""True bisectors of two curves and of a curve with itself, as the program `locus` gives them, checked from outside.

Run by ctest; by hand: LOCUS_BIN_DIR=build/bin python3 test/cli_curves_test.py
Samples are compared with a dense search in floats; arcs must join.
"""

import glob
import json
import math
import os
import random
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
import cli_test
from cli_test import PROGRAM, ROOT, Curve, check, parameter, read_result, run

JOBS = os.path.join(ROOT, "examples", "jobs", "true_bisector")


def places(curve, count=3000):
    """Points along the whole curve, in floats."""
    found = []
    for i in range(count + 1):
        x, y, w = curve.form.rough_values(float(curve.lo) + i / count * float(curve.hi - curve.lo))
        found.append((x / w + float(curve.form.origin[0]), y / w + float(curve.form.origin[1])))
    return found


def distance(point, polygon):
    """From the dense points' polygon: too great by the square of their spacing at most."""
    k = min(range(len(polygon)), key=lambda i: math.dist(point, polygon[i]))
    least = math.dist(point, polygon[k])
    for a, b in zip(polygon[max(0, k - 1):k + 1], polygon[max(0, k - 1) + 1:k + 2]):
        dx, dy = b[0] - a[0], b[1] - a[1]
        square = dx * dx + dy * dy
        f = min(1.0, max(0.0, ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / square)) if square else 0.0
        least = min(least, math.dist(point, (a[0] + f * dx, a[1] + f * dy)))
    return least


def check_job(name, text):
    result = run(["-"], text.encode())
    if not check(result.returncode == 0, f"{name}: status {result.returncode}: {result.stderr[:300]!r}"):
        return None
    data = read_result(result.stdout)
    job = json.loads(text, parse_float=Fraction)
    curves = [Curve(i["curve"]) for i in job["inputs"]]
    is_self = len(curves) == 1
    dense = [places(c) for c in curves]
    check(data["compute"] == "bisector" and data["trimmed"] is True and data["status"] == "certified" and data["undecided"] == [], f"{name}: status")
    check(data["degenerate"] == [], f"{name}: degenerate {data['degenerate']}")
    degree = [0] * len(data["vertices"])
    for i, arc in enumerate(data["arcs"]):
        where = f"{name}: arcs[{i}]"
        check(arc["inputs"] == ([0, 0] if is_self else [0, 1]), f"{where}: inputs {arc['inputs']}")
        for end, sample in (("source", arc["samples"][0]), ("target", arc["samples"][-1])):
            if arc["closed"]:
                continue
            degree[arc[end]] += 1
            v = data["vertices"][arc[end]]
            if "point" in v:
                check(math.dist(v["point"], sample["point"]) <= 1e-6 * data["scale"] + 2 * arc["error"], f"{where}: its {end} is elsewhere")
            elif check(v["kind"] == "infinity", f"{where}: its {end} has no point"):
                off = [a - b for a, b in zip(sample["point"], data["centre"])]
                check(off[0] * v["direction"][0] + off[1] * v["direction"][1] > 0, f"{where}: the direction at its {end} points inwards")
        for s in arc["samples"][::max(1, len(arc["samples"]) // 15)]:
            if math.dist(s["point"], data["centre"]) > 5 * data["scale"]:
                continue
            slack = 2e-6 * (data["scale"] + s["radius"]) + arc["error"]
            off = [distance(s["point"], d) for d in dense]
            if not check(all(abs(x - s["radius"]) <= slack for x in off), f"{where}: distances {off} of {s}"):
                break
            for k, u in enumerate(s["parameters"]):
                c = curves[0 if is_self else k]
                x, y, w = c.form.rough_values(parameter(u))
                foot = (x / w + float(c.form.origin[0]), y / w + float(c.form.origin[1]))
                check(abs(math.dist(foot, s["point"]) - s["radius"]) <= slack, f"{where}: foot {k} of {s}")
    for i, v in enumerate(data["vertices"]):
        if v["kind"] == "trim":
            check(len(v["feet"]) > 2 or any(f["feature"] != "interior" for f in v["feet"]), f"{name}: vertices[{i}]: feet {v['feet']}")
    if not is_self:
        ends = [d for v, d in zip(data["vertices"], degree) if v["kind"] == "infinity"]
        others = [d for v, d in zip(data["vertices"], degree) if v["kind"] != "infinity"]
        check(ends in ([], [1, 1]) and all(d == 2 for d in others) and data["components"] == 1, f"{name}: no simple curve: {degree}")
    return data


def random_job(rng):
    """Two curves on both sides of a line: disjoint."""
    curves = []
    for side in (-1, 1):
        n = rng.randint(1, 3)
        points = []
        while len(points) <= n:
            p = [rng.randint(-8, 8) / 4, side * rng.randint(1, 8) / 4]
            if not points or p != points[-1]:
                points.append(p)
        if n > 1 and len({p[1] for p in points}) == 1:
            points[1][1] += side / 2  # a line that runs back on itself is for a later version
        curve = {"degree": n, "control_points": points}
        if n > 1 and rng.random() < 0.3:
            curve["weights"] = [rng.randint(1, 3) for _ in points]
        curves.append({"curve": curve})
    return json.dumps({"compute": "bisector", "inputs": curves, "options": {"tolerance": 1e-4}})


def check_examples():
    files = sorted(glob.glob(os.path.join(JOBS, "*.json")))
    check(len(files) >= 10, f"{len(files)} jobs in {JOBS}")
    results = {}
    for path in files:
        with open(path, encoding="utf-8") as f:
            results[os.path.basename(path)[:-5]] = check_job(os.path.basename(path), f.read())
    cubics, rectangle, parallel = results["two_cubics"], results["rectangle_alone"], results["parallel_segments"]
    if cubics:
        between = [a for a in cubics["arcs"] if a["features"] == ["interior", "interior"]]
        ends = sorted(s["parameters"][0] for a in between for s in (a["samples"][0], a["samples"][-1]))
        check(len(between) == 1 and abs(ends[0] - 0.120669) < 1e-6 and abs(ends[1] - 0.438852) < 1e-6, f"two_cubics: {ends}")
    if rectangle:
        middle = sorted(tuple(round(x, 9) for x in v["point"]) for v in rectangle["vertices"] if v["kind"] == "trim")
        check(middle == [(0.5, 0.5), (2.5, 0.5)], f"rectangle_alone: {middle}")
    if parallel:
        check(all(abs(s["point"][1] - 0.5) < 1e-9 for a in parallel["arcs"] for s in a["samples"]), "parallel_segments: not in the middle")


def check_random(count=60):
    rng = random.Random(17)
    done = 0
    for k in range(count):
        text = random_job(rng)
        result = run(["-"], text.encode())
        if result.returncode == 4 and b"cusp" in result.stderr:
            continue
        done += check_job(f"random job {k}: {text}", text) is not None
    check(done > count // 2, f"only {done} random jobs were answered")


def main():
    if not os.access(PROGRAM, os.X_OK):
        print(f"{PROGRAM} is not there: build the target locus_cli first")
        return 1
    check_examples()
    check_random()
    return cli_test.report()


if __name__ == "__main__":
    sys.exit(main())
