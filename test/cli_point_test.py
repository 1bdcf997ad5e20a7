# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bisectors of a point and a curve, as the program `locus` gives them, checked from outside.

Run by ctest; by hand: LOCUS_BIN_DIR=build/bin python3 test/cli_point_test.py
The rational pieces are checked in fractions against the definition, samples against a dense search in floats.
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
from cli_test import PROGRAM, ROOT, Curve, casteljau, check, exact, parameter, read_result, run

JOBS = os.path.join(ROOT, "examples", "jobs", "point_curve")


def inputs_of(job_text):
    """The point and the curve, and which input the curve is."""
    inputs = json.loads(job_text, parse_float=Fraction)["inputs"]
    index = 0 if "curve" in inputs[0] else 1
    return tuple(exact(x) for x in inputs[1 - index]["point"]), Curve(inputs[index]["curve"]), index


def local_parameter(domain, u):
    """Of a piece: affine, or projective towards infinity."""
    lo, hi = domain
    if hi == "inf":
        return 1 - exact(lo) / u
    if lo == "-inf":
        return exact(hi) / u
    return (u - exact(lo)) / (exact(hi) - exact(lo))


def inside(domain, s):
    lo, hi = domain
    if hi == "inf":
        return exact(lo) / (1 - s)
    if lo == "-inf":
        return exact(hi) / s
    return exact(lo) + s * (exact(hi) - exact(lo))


def check_rational(name, data, point, curve):
    """Each piece is on the curve's normal and as far from the point as from the curve: as polynomials, by enough values."""
    for k, piece in enumerate(data["rational"]):
        domain, weights = piece["domain"][0], [exact(w) for w in piece["weights"]]
        rows = [[exact(p[i]) * (w if w != 0 else 1) for p, w in zip(piece["control_points"], weights)] for i in range(2)] + [weights]
        degree = piece["degrees"][0]
        check(len(weights) == degree + 1, f"{name}: rational[{k}]: degree {degree}, {len(weights)} weights")
        for j in range(1, 4 * degree + 8):
            s = Fraction(j, 4 * degree + 8)
            x, y, w = (casteljau(row, s)[0] for row in rows)
            u = inside(domain, s)
            sides = curve.form.homogeneous(u)
            (cx, dx), (cy, dy), (cw, dw) = sides[0]
            if w == 0 or cw == 0:
                continue
            q, r, t = (x / w, y / w), (cx / cw, cy / cw), (dx * cw - cx * dw, dy * cw - cy * dw)
            on_normal = (q[0] - r[0]) * t[0] + (q[1] - r[1]) * t[1] == 0
            equal = sum((a - b) ** 2 for a, b in zip(q, point)) == sum((a - b) ** 2 for a, b in zip(q, r))
            if not check(on_normal and equal, f"{name}: rational[{k}] is no bisector at u = {u}"):
                return
        for lo, hi in piece["intervals"]:
            check(as_number(lo) <= as_number(hi), f"{name}: rational[{k}]: interval {lo} {hi}")


def as_number(x):
    return float(Fraction(x)) if isinstance(x, str) and "inf" not in x else parameter(x)


def dense_places(curve, count=4000):
    """Points along the whole curve, in floats."""
    places = []
    for i in range(count + 1):
        s = i / count
        lo, hi = curve.lo, curve.hi
        if math.isinf(lo) and math.isinf(hi):
            u = math.tan((s - 0.5) * math.pi * 0.999999)
        elif math.isinf(hi):
            u = float(lo) + s / (1.000001 - s)
        elif math.isinf(lo):
            u = float(hi) - s / (1.000001 - s)
        else:
            u = float(lo) + s * float(hi - lo)
        x, y, w = curve.form.rough_values(u)
        if abs(w) > 1e-12:
            places.append((x / w + float(curve.form.origin[0]), y / w + float(curve.form.origin[1])))
    return places


def check_job(name, job_text):
    result = run(["-"], job_text.encode())
    if not check(result.returncode == 0, f"{name}: status {result.returncode}: {result.stderr[:300]!r}"):
        return
    data = read_result(result.stdout)
    point, curve, index = inputs_of(job_text)
    check(data["status"] == "certified" and data["undecided"] == [], f"{name}: undecided")
    check_rational(name, data, point, curve)
    p = tuple(map(float, point))
    for i, v in enumerate(data["vertices"]):
        inputs = [f["input"] for f in v["feet"]]
        check(1 - index in inputs and sorted(inputs) == inputs, f"{name}: vertices[{i}]: feet {v['feet']}")
        if v["kind"] == "infinity":
            check("point" not in v, f"{name}: vertices[{i}]: a point at infinity")
        else:
            check(abs(math.dist(v["point"], p) - v["radius"]) <= 1e-7 * (1 + v["radius"]), f"{name}: vertices[{i}]: radius")
    places = dense_places(curve)
    for i, arc in enumerate(data["arcs"]):
        where = f"{name}: arcs[{i}]"
        check(arc["inputs"] == [0, 1] and arc["features"][1 - index] == "point", f"{where}: inputs, features")
        for end, sample in (("source", arc["samples"][0]), ("target", arc["samples"][-1])):
            v = None if arc["closed"] else data["vertices"][arc[end]]
            if v and "point" in v:
                check(math.dist(v["point"], sample["point"]) <= 1e-6 * data["scale"] + 2 * arc["error"], f"{where}: its {end} is elsewhere")
        every = max(1, len(arc["samples"]) // 25)
        for s in arc["samples"][::every]:
            check(abs(math.dist(s["point"], p) - s["radius"]) <= 1e-6 * (1 + s["radius"]), f"{where}: radius at {s}")
            if data["trimmed"] and math.dist(s["point"], p) < 20 * data["scale"]:
                nearest = min(math.dist(s["point"], r) for r in places)
                slack = 1e-6 * (data["scale"] + s["radius"]) + arc["error"]
                if not check(nearest >= s["radius"] - slack, f"{where}: the curve is nearer at {s}: {nearest}"):
                    break
    if data["trimmed"] and data.get("cell"):
        check(sorted(data["cell"]["arcs"]) == list(range(len(data["arcs"]))), f"{name}: cell {data['cell']}")


def random_job(rng):
    n = rng.randint(1, 4)
    points = [[rng.randint(-8, 8) / 4, rng.randint(-8, 8) / 4] for _ in range(n + 1)]
    curve = {"degree": n, "control_points": points}
    if rng.random() < 0.4:
        curve["weights"] = [rng.randint(1, 3) for _ in points]
    inputs = [{"point": [f"{rng.randint(-40, 40)}/16", f"{rng.randint(-40, 40)}/16"]}, {"curve": curve}]
    rng.shuffle(inputs)
    return json.dumps({"compute": "bisector", "inputs": inputs, "options": {"trimmed": rng.random() < 0.8, "tolerance": 1e-4}})


def check_two_points():
    p, q = (0, 0), (2, 1 / 3)
    job = {"compute": "bisector", "inputs": [{"point": list(p)}, {"point": [2, "1/3"]}]}
    run_of_two = run(["-"], json.dumps(job).encode())
    check(run_of_two.returncode == 0, "two points are answered")
    result = json.loads(run_of_two.stdout)
    check(result["status"] == "certified" and len(result["arcs"]) == 1 and len(result["vertices"]) == 2, "of two points one line")
    for s in result["arcs"][0]["samples"]:
        x, y = s["point"]
        apart = [math.hypot(x - a, y - b) for a, b in (p, q)]
        check(max(abs(d - s["radius"]) for d in apart) <= 1e-12 * (1 + s["radius"]), f"{s} is as far from both points")
    job["inputs"][1] = job["inputs"][0]
    result = json.loads(run(["-"], json.dumps(job).encode()).stdout)
    check(not result["arcs"] and len(result["regions"]) == 1, "equal points have the plane as a region")


def main():
    if not os.access(PROGRAM, os.X_OK):
        print(f"{PROGRAM} is not there: build the target locus_cli first")
        return 1
    names = sorted(glob.glob(os.path.join(JOBS, "*.json")))
    check(len(names) > 10, "the example jobs are missing")
    for path in names:
        with open(path, encoding="utf-8") as f:
            check_job(os.path.basename(path), f.read())
    rng = random.Random(20261122)
    for i in range(60):
        text = random_job(rng)
        if run(["-"], text.encode()).returncode != 2:  # a single point
            check_job(f"random job {i}: {text}", text)
    check_two_points()
    return cli_test.report()


if __name__ == "__main__":
    sys.exit(main())
