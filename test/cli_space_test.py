# SPDX-License-Identifier: LGPL-3.0-or-later
"""Curvature, evolutes and rational bisectors in space, as the program `locus` gives them, checked from outside.

Run by ctest; by hand: LOCUS_BIN_DIR=build/bin python3 test/cli_space_test.py
Everything is checked in rationals, from the definition of the inputs: curvature by the quotient rule, roots by Sturm's theorem.
"""

import glob
import json
import math
import os
import random
import sys
import tempfile
from fractions import Fraction

sys.dont_write_bytecode = True
import cli_test
from cli_test import PROGRAM, ROOT, casteljau, check, exact, parameter, polar_form, read_result, run

JOBS = os.path.join(ROOT, "examples", "jobs")
LEAST = Fraction(1, 1 << 50)  # doubles near 1 are so far apart, about


# ----------------------------------------------------------------------------------------------------- polynomials
# Lists of coefficients of 1, z, z²…


def trim(p):
    n = len(p)
    while n and p[n - 1] == 0:
        n -= 1
    return p[:n]


def add(*ps):
    return trim([sum(p[i] for p in ps if i < len(p)) for i in range(max(map(len, ps)))])


def times(factor, p):
    return trim([factor * c for c in p])


def mul(*ps):
    product = [Fraction(1)]
    for p in ps:
        out = [Fraction(0)] * max(len(product) + len(p) - 1, 0)
        for i, a in enumerate(product):
            for j, b in enumerate(p):
                out[i + j] += a * b
        product = trim(out)
    return product


def derive(p):
    return [i * c for i, c in enumerate(p)][1:]


def value(p, z):
    out = 0 * z
    for c in reversed(p):
        out = out * z + c
    return out


def primitive(p):
    """Whole numbers without a common divisor, by a positive factor."""
    p = trim(p)
    if not p:
        return []
    denominator = math.lcm(*(Fraction(c).denominator for c in p))
    whole = [int(c * denominator) for c in p]
    divisor = math.gcd(*whole)
    return [c // divisor for c in whole]


def remainder(p, q):
    """Of primitive polynomials, by a positive factor."""
    p = list(p)
    size, sign = abs(q[-1]), 1 if q[-1] > 0 else -1
    while len(p) >= len(q):
        top, shift = sign * p[-1], len(p) - len(q)
        p = [size * c for c in p]
        for i, c in enumerate(q):
            p[shift + i] -= top * c
        p = trim(p)
    return primitive(p)


def gcd(p, q):
    p, q = primitive(p), primitive(q)
    while q:
        p, q = q, remainder(p, q)
    return p


def quotient(p, q):
    """p/q, which has no remainder."""
    p, out = [Fraction(c) for c in p], []
    while len(p) >= len(q):
        out.append(p[-1] / q[-1])
        for i in range(len(q)):
            p[len(p) - len(q) + i] -= out[-1] * q[i]
        p.pop()
    assert not trim(p)
    return trim(out[::-1])


def without(p, q):
    """p without all that it has in common with q."""
    while p and len(common := gcd(p, q)) > 1:
        p = quotient(p, common)
    return p


def sign(x):
    return (x > 0) - (x < 0)


def sign_beside(p, z, side):
    """Of a polynomial just before (-1) or after (1) a place."""
    odd = 1
    while p:
        at = value(p, z)
        if at != 0:
            return sign(at) * odd
        p, odd = derive(p), odd * side
    return 0


class Roots:
    """The distinct real roots of a polynomial, counted by Sturm's theorem."""

    def __init__(self, p):
        self.p = primitive(p)
        self.chain = []
        if self.p:
            self.repeated = gcd(self.p, derive(self.p))
            simple = primitive(quotient(self.p, self.repeated))
            self.chain = [simple, primitive(derive(simple))]
            while self.chain[-1]:
                self.chain.append([-c for c in remainder(self.chain[-2], self.chain[-1])])

    def changes(self, z):
        signs = [s for s in (sign(value(p, z)) for p in self.chain) if s]
        return sum(a != b for a, b in zip(signs, signs[1:]))

    def at(self, z):
        return bool(self.p) and value(self.p, z) == 0

    def within(self, lo, hi):
        """Between lo and hi, both included."""
        if not self.p:
            return 0
        return self.at(lo) + (self.changes(lo) - self.changes(hi) if lo < hi else 0)

    def inside(self, lo, hi):
        return self.within(lo, hi) - self.at(lo) - self.at(hi)

    def multiplicity(self, lo, hi):
        """Of the only root between."""
        m, p = 0, self.p
        while len(p) > 1 and Roots(p).within(lo, hi):
            m, p = m + 1, gcd(p, derive(p))
        return m


# ---------------------------------------------------------------------------------------------------------- curves


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def length(a):
    return math.hypot(*map(float, a))


class Span:
    """x = rows/weight on lo ≤ z ≤ hi, where z is the parameter u or, through infinity, -1/u."""

    def __init__(self, rows, weight, lo, hi, inverse=False):
        positive = sign(value(weight, (lo + hi) / 2))
        self.rows, self.weight = [times(positive, row) for row in rows], times(positive, weight)
        self.lo, self.hi, self.inverse = lo, hi, inverse
        self.floats = [list(map(float, p)) for p in self.rows + [self.weight]]

    def local(self, u):
        if not self.inverse:
            return Fraction(u)
        return Fraction(0) if math.isinf(u) else -1 / Fraction(u)

    def parameter(self, z):
        if not self.inverse:
            return z
        return -1 / z if z else math.inf

    def contains(self, u):
        if math.isinf(u):
            return self.inverse
        return (not self.inverse or u != 0) and self.lo <= self.local(u) <= self.hi

    def values(self, u):
        """Point, first and second derivative."""
        z = self.local(u)
        x, first, second = ([value(p, z) for p in ps] for ps in
                            (self.rows, [derive(p) for p in self.rows], [derive(derive(p)) for p in self.rows]))
        w, dw, ddw = value(self.weight, z), value(derive(self.weight), z), value(derive(derive(self.weight)), z)
        x = [c / w for c in x]
        first = [(d - p * dw) / w for d, p in zip(first, x)]
        second = [(d - 2 * e * dw - p * ddw) / w for d, e, p in zip(second, first, x)]
        return x, first, second

    def analyse(self):
        """Polynomials with the signs of what they are named after, and their roots but for those where the curve stands still."""
        if hasattr(self, "speed"):
            return
        w, dw = self.weight, derive(self.weight)
        velocity = [add(mul(derive(x), w), times(-1, mul(x, dw))) for x in self.rows]  # x' = velocity/w²
        change = [derive(v) for v in velocity]
        # x'×x'' = bend/w³; the numerator of velocity × change has a factor w.
        pairs = [(0, 1)] if len(self.rows) == 2 else [(1, 2), (2, 0), (0, 1)]
        self.bend = [quotient(add(mul(velocity[i], change[j]), times(-1, mul(velocity[j], change[i]))), w) for i, j in pairs]
        self.speed = add(*(mul(v, v) for v in velocity))
        s, w2 = self.speed, mul(w, w)
        self.squared_bend = add(*(mul(b, b) for b in self.bend))
        # κ² = n/s³, and κ = β·w³/s^(3/2) in the plane.
        n = mul(w2, w2, w2, self.squared_bend)
        self.squared_curvature_slope = add(mul(derive(n), s), times(-3, mul(n, derive(s))))
        self.torsion = []
        if len(self.rows) == 2:
            b = mul(w2, w, self.bend[0])
            self.curvature_slope = add(mul(derive(b), s), times(Fraction(-3, 2), mul(b, derive(s))))
            critical, bend = self.curvature_slope, self.bend[0]
        else:
            critical, bend = self.squared_curvature_slope, self.squared_bend
            self.torsion = add(*(mul(derive(change[k]), self.bend[k]) for k in range(3)))
        self.critical = critical
        self.critical_roots = Roots(without(without(critical, s), w))
        self.full_critical_roots = Roots(without(without(self.squared_curvature_slope, s), w))
        self.bend_roots, self.torsion_roots = Roots(without(bend, s)), Roots(without(self.torsion, s))
        self.standstills = Roots(s)

    # What the curvature is at an end, exactly: in the plane with its sign, in space its square.
    def curvature_at(self, z):
        s, w = value(self.speed, z), value(self.weight, z)
        square = w**6 * value(self.squared_bend, z) / s**3
        return square * (sign(value(self.bend[0], z)) if len(self.rows) == 2 else 1)

    def slope_at(self, z):
        """Derivative of the curvature by arc length, or in space of half its square, with its sign and squared."""
        s, w = value(self.speed, z), value(self.weight, z)
        if len(self.rows) == 2:
            return w * w * value(self.curvature_slope, z) / s**3
        if value(self.squared_bend, z) == 0:
            return 0
        slope = value(self.squared_curvature_slope, z) * w * w / s**4
        return sign(slope) * slope * slope / s


def powers(form, lo, hi):
    """A Bernstein form on [lo, hi] in powers of u."""
    s, r = [-lo / (hi - lo), 1 / (hi - lo)], [hi / (hi - lo), -1 / (hi - lo)]
    n = len(form) - 1
    return add(*(times(math.comb(n, i) * c, mul(*[s] * i, *[r] * (n - i))) for i, c in enumerate(form)), [])


class Curve:
    """A curve of a job as spans, with the joints between them."""

    def __init__(self, data):
        self.spans = []
        if "monomial" in data:
            rows = [[exact(c) for c in data["monomial"].get(key, [1])] for key in "xyzw" if key in data["monomial"] or key == "w"]
            n = max(map(len, rows))
            rows = [row + [Fraction(0)] * (n - len(row)) for row in rows]
            if data["domain"] == ["-inf", "inf"]:
                turned = [[c * (-1) ** k for k, c in enumerate(row)][::-1] for row in rows]
                self.spans = [Span(rows[:-1], rows[-1], Fraction(-1), Fraction(1)), Span(turned[:-1], turned[-1], Fraction(-1), Fraction(1), True)]
                self.closed = True
            else:
                self.spans = [Span(rows[:-1], rows[-1], *map(exact, data["domain"]))]
                self.closed = False
        else:
            d = data["degree"]
            points = [[exact(x) for x in p] for p in data["control_points"]]
            weights = [exact(w) for w in data.get("weights", [1] * len(points))]
            rows = [[p[k] * w for p, w in zip(points, weights)] for k in range(len(points[0]))] + [weights]
            knots = [exact(k) for k in data.get("knots", [0] * (d + 1) + [1] * (d + 1))]
            for i in range(d, len(points)):
                lo, hi = knots[i], knots[i + 1]
                if lo < hi:
                    forms = [powers([polar_form(row, knots, d, i, [lo] * (d - j) + [hi] * j) for j in range(d + 1)], lo, hi) for row in rows]
                    self.spans.append(Span(forms[:-1], forms[-1], lo, hi))
            self.closed = data.get("closed", False)
        self.dimension = len(self.spans[0].rows)

    def sides(self, u):
        """Point and derivatives at u; at a joint of both spans."""
        found = [span.values(u) for span in self.spans if span.contains(u)]
        if not found:  # the rounding of an end
            ends = [(abs(Fraction(u) - end), span, end) for span in self.spans for end in (span.lo, span.hi)]
            _, span, end = min(ends, key=lambda e: e[0])
            found = [span.values(end)]
        return found

    def rough(self, u):
        """Point and derivative in floats."""
        span = next((s for s in self.spans if s.contains(u)), None) or self.spans[0 if u < self.spans[0].lo else -1]
        z = float(span.local(u))
        x, dx = ([value(p, z) for p in ps] for ps in (span.floats, [derive(p) for p in span.floats]))
        return [c / x[-1] for c in x[:-1]], [d * x[-1] - c * dx[-1] for c, d in zip(x[:-1], dx[:-1])]

    def joints(self):
        """Pairs of spans that meet, and the parameter."""
        pairs = list(zip(self.spans, self.spans[1:] + self.spans[:1]))
        for a, b in pairs if self.closed else pairs[:-1]:
            at = {a.parameter(a.hi), b.parameter(b.lo)}
            yield a, b, at

    def ends(self):
        return [] if self.closed else [(self.spans[0], self.spans[0].lo, "start"), (self.spans[-1], self.spans[-1].hi, "end")]


def centre_of(x, first, second):
    """Of the osculating circle, with the squared radius; nothing where the curvature vanishes."""
    speed = dot(first, first)
    along = dot(first, second) / speed
    k = [(b - along * a) / speed for a, b in zip(first, second)]  # the curvature vector
    square = dot(k, k)
    if square == 0:
        return None, None
    return [c + n / square for c, n in zip(x, k)], 1 / square


def root_of(x):
    """The square root of a fraction, as a float."""
    scale = 1 << 128
    return math.isqrt(x.numerator * scale // x.denominator) / (1 << 64)


# ------------------------------------------------------------------------------------------------------- curvature

CURVATURE_KEYS = ["compute", "status", "scale", "equations", "vertices", "degenerate", "joined_by_tolerance", "undecided", "statistics"]
EVENTS = {"extremum", "stationary", "jump", "kink", "inflection", "torsion_zero", "cusp"}


def job_of(compute, curve):
    return json.dumps({"compute": compute, "inputs": [{"curve": curve}]})


def inputs_of(text):
    return json.loads(text, parse_float=Fraction)["inputs"]


def answer(name, text, *arguments, statuses=(0, 1)):
    """The program's result, and its status, which must agree with what it says."""
    result = run(["-", *arguments], stdin=text.encode())
    if not check(result.returncode in statuses, f"{name}: status {result.returncode}: {result.stderr[:300]!r}") or result.returncode > 1:
        return None
    data = read_result(result.stdout)
    check((result.returncode == 1) == (data["undecided"] != []), f"{name}: status {result.returncode} with the undecided {data['undecided'][:2]}")
    check((data["status"] == "certified") == (data["undecided"] == []), f"{name}: {data['status']} with the undecided {data['undecided'][:2]}")
    return data


def test_curvature():
    for path in sorted(glob.glob(os.path.join(JOBS, "*", "curvature_*.json"))):
        with open(path) as f:
            check_curvature(os.path.basename(path), f.read())
    for name, curve in SPECIAL_CURVES:
        check_curvature(name, job_of("curvature", curve))


def check_curvature(name, text, statuses=(0,)):
    data = answer(name, text, statuses=statuses)
    if data is None:
        return False
    check(list(data) == CURVATURE_KEYS and data["compute"] == "curvature", f"{name}: keys {list(data)}")
    curve = Curve(inputs_of(text)[0]["curve"])
    for span in curve.spans:
        span.analyse()
        if span.standstills.inside(span.lo, span.hi):
            return True  # cusps: the library cuts the curve there
    check_kinds_of_pieces(name, curve, data["degenerate"])
    expected = expected_at_joints(curve) + expected_at_ends(curve)
    left = []
    for i, v in enumerate(data["vertices"]):
        where = f"{name}: vertices[{i}]"
        check(v["kind"] in EVENTS and len(v["feet"]) == 1 and v["feet"][0]["input"] == 0, f"{where}: {v}")
        [[lo, hi]] = v["feet"][0]["parameters"]
        lo, hi = parameter(lo), parameter(hi)
        check_numbers(where, curve, v, lo, hi)
        match = next((e for e in expected if e[0] == group_of(v) and lo == hi and (lo in e[1] or math.isinf(lo) and math.inf in e[1])), None)
        if match:
            expected.remove(match)
            check(match[2] == description(v), f"{where}: {description(v)}, not {match[2]}")
        else:
            left.append((where, v, lo, hi))
    check(not expected, f"{name}: missing {expected}")
    check_inside(name, curve, left)
    return True


def group_of(v):
    return v["kind"] if v["kind"] in ("inflection", "torsion_zero", "cusp") else "critical"


def description(v):
    return v["kind"], v.get("extremum"), v["feet"][0]["feature"], v["changes_sign"]


def named_extremum(before, after):
    return "maximum" if before > 0 > after else "minimum" if before < 0 < after else None


def expected_at_joints(curve):
    found = []
    for a, b, at in curve.joints():
        if value(a.speed, a.hi) == 0 or value(b.speed, b.lo) == 0:
            continue
        t, r = a.values(a.parameter(a.hi))[1], b.values(b.parameter(b.lo))[1]
        turned = any(t[i] * r[j] != t[j] * r[i] for i in range(len(t)) for j in range(i))
        if turned or dot(t, r) < 0:
            continue  # a corner
        k, l = a.curvature_at(a.hi), b.curvature_at(b.lo)
        slopes = a.slope_at(a.hi), b.slope_at(b.lo)
        form = "curvature_slope" if curve.dimension == 2 else "squared_curvature_slope"
        before, after = sign_beside(getattr(a, form), a.hi, -1), sign_beside(getattr(b, form), b.lo, 1)
        stands = slopes[0] == 0 and (before != 0 or after != 0)
        changes = before * after < 0
        if k != l or slopes[0] != slopes[1] or stands:
            kind = "jump" if k != l else "kink" if slopes[0] != slopes[1] else "extremum" if changes else "stationary"
            found.append(("critical", at, (kind, named_extremum(before, after), "interior", changes)))
        if curve.dimension == 2:
            found += zeros_at_joint("inflection", at, a.bend[0], a.hi, b.bend[0], b.lo, True)
        elif a.squared_bend and b.squared_bend and 0 in (k, l):
            found.append(("inflection", at, ("inflection", None, "interior", False)))
        found += zeros_at_joint("torsion_zero", at, a.torsion, a.hi, b.torsion, b.lo, True)
    return found


def zeros_at_joint(kind, at, f, z, g, y, signed):
    before, after = sign_beside(f, z, -1), sign_beside(g, y, 1)
    if not (f and g) or (before == after and value(f, z) != 0 and value(g, y) != 0):
        return []
    return [(kind, at, (kind, None, "interior", signed and before * after < 0))]


def expected_at_ends(curve):
    found = []
    for span, z, feature in curve.ends():
        if value(span.speed, z) == 0:
            continue
        for group, roots, kind in (("critical", span.critical_roots, "stationary"), ("inflection", span.bend_roots, "inflection"),
                                   ("torsion_zero", span.torsion_roots, "torsion_zero")):
            if roots.at(z):
                found.append((group, {z}, (kind, None, feature, False)))
    return [(g, {float(u) for u in at} | at, d) for g, at, d in found]


def check_inside(name, curve, found):
    """What lies inside of spans: each encloses one root, and there are as many as roots."""
    for n, span in enumerate(curve.spans):
        inside = [(w, v, span.local(lo), span.local(hi)) for w, v, lo, hi in found
                  if span.contains(lo) and span.contains(hi) and (not span.inverse or lo * hi >= 0)]
        for group, roots in (("critical", span.critical_roots), ("inflection", span.bend_roots), ("torsion_zero", span.torsion_roots)):
            here = [p for p in inside if group_of(p[1]) == group]
            if span.inverse:
                here.sort(key=lambda p: p[2])
            number = roots.inside(span.lo, span.hi)
            check(len(here) == number, f"{name}: {len(here)} of kind {group} in span {n}, where {number} are")
            check(all(p[3] <= q[2] and p[2] < q[3] for p, q in zip(here, here[1:])), f"{name}: one {group} twice, in span {n}")
            for where, v, lo, hi in here:
                if not check(lo <= hi <= lo + 2 * LEAST * max(1, abs(lo)) and roots.within(lo, hi) == 1, f"{where}: no root, or many, in [{float(lo)}, {float(hi)}]"):
                    continue
                check_root(where, curve, span, v, roots, lo, hi)


def check_root(where, curve, span, v, roots, lo, hi):
    m = roots.multiplicity(lo, hi)
    if curve.dimension == 3 and v["kind"] == "inflection":
        m //= 2  # the form here is a square
    check(v["multiplicity"] == m, f"{where}: multiplicity {v['multiplicity']}, not {m}")
    form = {"critical": span.critical, "inflection": span.bend[0], "torsion_zero": span.torsion}[group_of(v)]
    before, after = sign_beside(form, lo, -1), sign_beside(form, hi, 1)
    if v["kind"] in ("extremum", "stationary"):
        changes = before * after < 0
        check((v["kind"] == "extremum") == changes and v.get("extremum") == named_extremum(before, after), f"{where}: {v['kind']}, {v.get('extremum')}")
        # The same, from the square of the curvature.
        check(span.full_critical_roots.within(lo, hi) >= 1, f"{where}: the curvature's square is not stationary")
        squares = sign_beside(span.squared_curvature_slope, lo, -1) * sign_beside(span.squared_curvature_slope, hi, 1)
        check(span.bend_roots.within(lo, hi) > 0 or (squares < 0) == changes, f"{where}: the derivative's sign")
    else:
        changes = before * after < 0 and (curve.dimension == 2 or v["kind"] == "torsion_zero")
    check(v["changes_sign"] == changes, f"{where}: changes_sign {v['changes_sign']}")
    check(v["feet"][0]["feature"] == "interior", f"{where}: {v['feet']}")


def check_numbers(where, curve, v, lo, hi):
    """Point, curvature, torsion and osculating circle against the exact ones in the enclosure."""
    span = next((s for s in curve.spans if s.contains(lo) and s.contains(hi)), None)
    if not check(span is not None, f"{where}: [{lo}, {hi}] is outside of all spans"):
        return
    # At a jump the numbers are those of the span before: the first that has it, or in a closed curve the last.
    if lo == hi and curve.closed and lo == curve.spans[0].lo and not curve.spans[-1].inverse:
        span = curve.spans[-1]
    z = [span.local(lo), (span.local(lo) + span.local(hi)) / 2, span.local(hi)]
    places = [span.parameter(c) for c in z]
    values = [span.values(u) for u in places]
    # How far the point moves within the enclosure, and how far doubles are apart.
    x = [p[0] for p in values]
    spread = length(minus(x[0], x[1])) + length(minus(x[1], x[2]))
    off = length(minus(map(Fraction, v["point"]), x[1]))
    check(off <= v["error"] + spread, f"{where}: the point is off by {off:.3g}, its error says {v['error']:.3g}")
    size = 1 + max(map(abs, v["point"]))
    check(v["error"] <= 1e-10 * size, f"{where}: error {v['error']}")
    if v["kind"] == "cusp":
        return
    squares = [span.curvature_at(c) for c in z]
    bent = all(squares) and span.bend_roots.within(z[0], z[2]) == 0
    turns = [root_of(abs(k)) * (sign(k) if curve.dimension == 2 else 1) for k in squares]
    a, b = v["curvature"]
    slack = 1e-14 * max(map(abs, turns)) + 1e-18
    least = 0 if curve.dimension == 3 and not bent else min(turns)  # zero somewhere in between
    check(a <= b and a <= max(turns) + slack and b >= least - slack, f"{where}: curvature [{a}, {b}], not {turns}")
    check(b - a <= 1e-6 * (1 + abs(a)), f"{where}: curvature [{a}, {b}]")
    if curve.dimension == 3 and bent:
        torsions = [float(value(span.weight, c) ** 3 * value(torsion_numerator(span), c) / (value(span.weight, c) ** 3 * value(span.squared_bend, c))) for c in z]
        slack = 1e-14 * max(map(abs, torsions)) + 1e-18
        if check("torsion" in v, f"{where}: no torsion"):
            a, b = v["torsion"]
            check(a <= max(torsions) + slack and b >= min(torsions) - slack, f"{where}: torsion [{a}, {b}], not {torsions}")
    if v["kind"] == "inflection":
        check("centre" not in v, f"{where}: an inflection's centre")
    elif bent:
        centres = [centre_of(*p) for p in values]
        spread = length(minus(centres[0][0], centres[1][0])) + length(minus(centres[1][0], centres[2][0]))
        if not check("centre" in v, f"{where}: no centre"):
            return
        off = length(minus(map(Fraction, v["centre"]), centres[1][0]))
        check(off <= v["centre_error"] + spread, f"{where}: the centre is off by {off:.3g}, its error says {v['centre_error']:.3g}")
        radius = root_of(centres[1][1])
        off = abs(v["radius"] - radius)
        check(off <= v["centre_error"] + spread + 4e-16 * radius, f"{where}: the radius is off by {off:.3g}, its error says {v['centre_error']:.3g}")


def torsion_numerator(span):
    """τ = w²·this/|bend|², where ⟨x', x''×x'''⟩ = this/w⁴: here over one more factor w each."""
    return mul(span.weight, span.torsion)


def check_kinds_of_pieces(name, curve, degenerate):
    kinds = {"straight": 0, "constant curvature": 0, "plane": 0}
    for span in curve.spans:
        straight = not span.squared_bend
        kinds["straight"] += straight
        kinds["constant curvature"] += not straight and not span.squared_curvature_slope
        kinds["plane"] += curve.dimension == 3 and not straight and not span.torsion
    said = [d["kind"] for d in degenerate]
    for kind, number in kinds.items():
        check((kind in said) == (number > 0) and (curve.spans[-1].inverse or said.count(kind) == number), f"{name}: {kind}: {said}, not {number}")


def bezier(points, **more):
    return dict({"degree": len(points) - 1, "control_points": points}, **more)


SPECIAL_CURVES = [
    ("a line", bezier([[0, 0], [1, 2]])),
    ("an arc of a circle", bezier([[1, 0], [1, 1], [0, 1]], weights=[1, 1, 2])),
    ("a parabola's half", bezier([[0, 0], [1, 0], [2, 1]])),
    ("an inflection that is an end", bezier([[0, 0], [1, 0], [2, 0], [3, 1]])),
    ("a double inflection", {"monomial": {"x": [0, 1], "y": [0, 0, 0, 0, 1]}, "domain": [-1, 2]}),
    ("a triple inflection", {"monomial": {"x": [0, 1], "y": [0, 0, 0, 0, 0, 1]}, "domain": ["-1/3", "1/2"]}),
    ("a whole ellipse, moved", {"monomial": {"x": [5, "1/3", 1], "y": [0, 4, 1], "w": [1, 0, 1]}, "domain": ["-inf", "inf"]}),
    ("a line that becomes a parabola", {"degree": 2, "control_points": [[0, 0], [1, 0], [2, 0], [4, 3]], "knots": [0, 0, 0, 1, 2, 2, 2]}),
    ("a corner", {"degree": 2, "control_points": [[0, 0], [1, 1], [2, 0], [3, 4], [4, 0]], "knots": [0, 0, 0, 1, 1, 2, 2, 2]}),
    ("a curve with a cusp at its end", bezier([[0, 0], [0, 0], [2, 1], [3, 0]])),
    ("a closed spline", {"degree": 3, "closed": True, "control_points": [[0, 0], [1, 0], [3, 1], [3, 3], [0, 4], [-2, 2], [-1, 0], [0, 0]],
                         "knots": [0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5]}),
    ("a line in space", bezier([[0, 0, 1], [1, 2, 0]])),
    ("an arc of a circle in space", bezier([[1, 0, 3], [1, 1, 3], [0, 1, 3]], weights=[1, 1, 2])),
    ("a plane curve in space", bezier([[0, 0, 0], [1, 2, 3], [3, 1, 4], [4, 3, 7]])),
    ("a space curve without curvature at a point", {"monomial": {"x": [0, 1], "y": [0, 0, 0, 1], "z": [0, 0, 0, 0, 1]}, "domain": ["-1/2", 1]}),
    ("torsion of multiplicity two", {"monomial": {"x": [0, 1], "y": [0, 0, 1], "z": [0, 0, 0, 0, 0, 1]}, "domain": [-1, "1/2"]}),
    ("torsion that changes its sign", {"monomial": {"x": [0, 1], "y": [0, 0, 1], "z": [0, 0, 0, 0, 1, 1]}, "domain": [-1, "1/2"]}),
    ("a cubic spline in space", {"degree": 3, "control_points": [[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 3], [6, 1, 1], [7, 4, 0]],
                                 "knots": [0, 0, 0, 0, 1, 2, 3, 3, 3, 3]}),
    ("a quadratic spline in space", {"degree": 2, "control_points": [[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 3]], "knots": [0, 0, 0, 1, 2, 2, 2]}),
]


def random_curve(rng, dimension):
    degree = rng.randint(2, 4)
    number = rng.choice([lambda: rng.randint(-3, 3), lambda: rng.randint(-16, 16) / 4])
    spans = rng.choice([1, 1, 2, 3])
    data = {"degree": degree, "control_points": [[number() for _ in range(dimension)] for _ in range(degree + spans)]}
    if spans > 1:
        data["knots"] = [0] * (degree + 1) + list(range(1, spans)) + [spans] * (degree + 1)
    if rng.random() < 0.4:
        data["weights"] = [rng.choice([1, 1, 2, 3, "1/2"]) for _ in data["control_points"]]
    return data


def test_random_curves():
    seed = int(os.environ.get("LOCUS_TEST_SEED", "1"))
    answered = 0
    for i in range(40):
        rng = random.Random(1000 * seed + i)
        curve = random_curve(rng, 2 + i % 2)
        name = f"LOCUS_TEST_SEED={seed}, curve {i} {json.dumps(curve)}"
        # Among so few digits there are curves that are one point, or stand still (2), and cusps (4).
        answered += check_curvature("curvature, " + name, job_of("curvature", curve), (0, 2, 4))
        check_evolute("evolute, " + name, job_of("evolute", curve), (0, 1, 2, 4))
    check(answered >= 30, f"only {answered} of 40 random curves were answered")


# --------------------------------------------------------------------------------------------------------- evolutes


def test_pictures():
    """Planar curves have pictures of their evolutes, with the points of their curvature."""
    for path in sorted(glob.glob(os.path.join(JOBS, "curvature", "*.json"))):
        name = os.path.basename(path)
        result = run([path, "--svg", "-"])
        if check(result.returncode == 0, f"{name}: picture: {result.returncode} {result.stderr[:300]!r}"):
            cli_test.check_picture(name, result.stdout, False)


def test_evolutes():
    for path in sorted(glob.glob(os.path.join(JOBS, "*", "evolute_*.json"))):
        with open(path) as f:
            check_evolute(os.path.basename(path), f.read())
    for name, curve in SPECIAL_CURVES:
        check_evolute("evolute of " + name, job_of("evolute", curve))
    closed = answer("evolute of an ellipse", job_of("evolute", SPECIAL_CURVES[6][1]))
    check([a["closed"] for a in closed["arcs"]] == [True] and len(closed["arcs"][0]["irregular"]) == 4, "an ellipse's evolute is no closed arc with four cusps")
    circle = answer("evolute of a circle", job_of("evolute", SPECIAL_CURVES[1][1]))
    check([v["kind"] for v in circle["vertices"]] == ["isolated"] and math.hypot(*circle["vertices"][0]["point"]) < 1e-12 and circle["arcs"] == [],
          f"a circle's evolute: {circle['vertices']}")


def check_scale(name, feet, data):
    """The scale is the diameter of the inputs' bounding box, the centre its middle; spans to infinity are only in part in it."""
    points, seen = [], True
    for f in feet:
        if f.point:
            points.append(list(map(float, f.point)))
        elif f.curve:
            seen = seen and not any(s.inverse for s in f.curve.spans)
            points += [[float(c) for c in s.values(s.parameter(s.lo + (s.hi - s.lo) * Fraction(k, 16)))[0]] for s in f.curve.spans for k in range(17)]
        else:
            points += [[float(c) for c in f.surface.at(u, v)[0]] for a, b, _ in f.surface.patches for u in (a[0], sum(a) / 2, a[1]) for v in (b[0], sum(b) / 2, b[1])]
    lo, hi = zip(*((min(x), max(x)) for x in zip(*points)))
    scale, cut = data["scale"], data["cut_radius"]
    check(cut >= 10 * scale > 0, f"{name}: cut_radius {cut}, scale {scale}")
    if seen:
        check(scale >= math.dist(lo, hi) * (1 - 1e-9), f"{name}: scale {scale}, but the inputs have the diameter {math.dist(lo, hi)}")
        check(all(a - scale <= c <= b + scale for a, b, c in zip(lo, hi, data["centre"])), f"{name}: centre {data['centre']}")


def check_evolute(name, text, statuses=(0,)):
    data = answer(name, text, "--tolerance", "1e-3", statuses=statuses)
    if data is None:
        return
    curve = Curve(inputs_of(text)[0]["curve"])
    keys = [k for k in cli_test.KEYS]
    keys[keys.index("regions"):keys.index("regions")] = (["sheets"] if curve.dimension == 3 else []) + (["rational"] if "rational" in data else [])
    check(list(data) == keys and data["compute"] == "evolute" and data.get("sheets", []) == [], f"{name}: keys {list(data)}")
    check(data["components"] == cli_test.components(data), f"{name}: components")
    check_scale(name, [Foot({"curve": inputs_of(text)[0]["curve"]})], data)
    for span in curve.spans:
        span.analyse()
    check_rational_evolute(name, curve, data.get("rational", []))
    for i, v in enumerate(data["vertices"]):
        check_evolute_vertex(f"{name}: vertices[{i}]", v, curve, data)
    for i, arc in enumerate(data["arcs"]):
        check_evolute_arc(f"{name}: arcs[{i}]", arc, curve, data)
    if not any(s.standstills.inside(s.lo, s.hi) for s in curve.spans):
        check_ends_at_infinity(name, curve, data)
        if curve.dimension == 2:
            check_cusps(name, curve, data)
        check_drawn(name, curve, data)


def pieces_at(piece, s):
    """The parameters' values at a place of a piece's unit cube."""
    out = []
    for (lo, hi), t in zip(piece["domain"], s):
        lo, hi = (None if x in ("-inf", "inf") else Fraction(x) for x in (lo, hi))
        out.append(lo / (1 - t) if hi is None else hi / t if lo is None else lo + t * (hi - lo))
    return out


def exact_image(piece, s):
    """A point of an exact result from its control points and weights; nothing at infinity."""

    def blend(form, at):
        while isinstance(form[0], list) and len(at) > 1:
            form = [blend(row, at[1:]) for row in form]
            at = at[:1]
        return casteljau(form, at[0])[0]

    def rows(control, weights):
        if isinstance(weights, list):
            return [rows(c, w) for c, w in zip(control, weights)]
        w = Fraction(weights)
        return [Fraction(c) * (w or 1) for c in control] + [w]

    def part(form, k):
        return [part(x, k) for x in form] if isinstance(form[0], list) else form[k]

    form = rows(piece["control_points"], piece["weights"])
    *x, w = [blend(part(form, k), s) for k in range(len(flat_first(form)))]
    return [c / w for c in x] if w else None


def flat_first(form):
    while isinstance(form[0], list):
        form = form[0]
    return form


def sizes(form):
    return [len(form)] + sizes(form[0]) if isinstance(form, list) else []


def check_form(where, piece):
    n = [d + 1 for d in piece["degrees"]]
    check(list(piece) == ["domain", "degrees", "control_points", "weights", "intervals"], f"{where}: keys {list(piece)}")
    check(sizes(piece["weights"]) == n and sizes(piece["control_points"])[:-1] == n, f"{where}: degrees {piece['degrees']}")
    # Of a curve pairs of parameters, of a surface boxes.
    check(piece["intervals"] == (piece["domain"] if len(piece["domain"]) == 1 else [piece["domain"]]), f"{where}: intervals {piece['intervals']}")


def check_rational_evolute(name, curve, pieces):
    bent = [s for s in curve.spans if s.squared_bend]
    check(bool(pieces) == bool(bent) and (curve.spans[-1].inverse or "cusp" in name or any(s.standstills.inside(s.lo, s.hi) for s in curve.spans)
                                          or len(pieces) == len(bent)), f"{name}: {len(pieces)} exact pieces for {len(bent)}")
    for i, piece in enumerate(pieces):
        where = f"{name}: rational[{i}]"
        check_form(where, piece)
        for s in (Fraction(1, 7), Fraction(2, 5), Fraction(1, 2), Fraction(6, 7), Fraction(12, 13)):
            [u] = pieces_at(piece, [s])
            x, first, second = curve.sides(u)[0]
            e = exact_image(piece, [s])
            if e is None:
                continue
            e = minus(e, x)
            ok = dot(e, first) == 0 and dot(e, second) == dot(first, first)
            if curve.dimension == 3:
                ok = ok and dot(e, cross(first, second)) == 0
            check(ok, f"{where}: not the centre of curvature at u = {u}")


def nearby_centres(curve, u):
    """The exact centres at a parameter, with radius, the foot, its tangent and how much the rounding of u can matter."""
    if math.isinf(u):
        around = [u]
    else:
        step = 4 * math.ulp(u) + 1e-18
        around = [u, u - step, u + step]
    for side in range(2):
        values = []
        for t in around:
            sides = curve.sides(Fraction(t) if not math.isinf(t) else t)
            values.append(sides[min(side, len(sides) - 1)])
        if any(dot(v[1], v[1]) == 0 for v in values):
            continue
        centres = [centre_of(*v) for v in values]
        if any(c[0] is None for c in centres):
            continue
        spread = sum(length(minus(c[0], centres[0][0])) for c in centres[1:])
        yield centres[0][0], root_of(centres[0][1]), values[0][0], values[0][1], spread


def check_centre(where, curve, scale, u, point, radius):
    tried = []
    for centre, rho, x, tangent, spread in nearby_centres(curve, u):
        allowed = 1e-9 * max(scale, rho) + spread
        d = minus(map(Fraction, point), x)
        tried.append((length(minus(map(Fraction, point), centre)) / allowed, abs(rho - radius) / allowed, abs(length(d) - radius) / allowed,
                      abs(float(dot(d, tangent))) / length(tangent) / allowed))
    if tried:
        check(min(map(max, tried)) <= 1, f"{where}: no centre of curvature at {u}: off by {min(tried, key=max)} of what is allowed")


def check_evolute_vertex(where, v, curve, data):
    check(v["kind"] in ("boundary", "corner", "infinity", "isolated"), f"{where}: {v['kind']}")
    [[lo, hi]] = v["feet"][0]["parameters"]
    lo, hi = parameter(lo), parameter(hi)
    middle = lo if lo == hi else lo + (hi - lo) / 2
    if v["kind"] != "infinity":
        if not check("point" in v, f"{where}: no point"):
            return
        check_centre(where, curve, data["scale"], middle, v["point"], v["radius"])
        return
    x, first, _ = curve.sides(middle)[0]
    check("point" not in v and abs(math.hypot(*v["direction"]) - 1) < 1e-12, f"{where}: {v}")
    check(abs(dot(v["direction"], map(float, first))) <= 1e-9 * length(first), f"{where}: does not run along the normal")
    if curve.dimension == 2:
        check(("asymptote" in v) == (v.get("multiplicity", 1) == 1), f"{where}: multiplicity and asymptote")
    if "asymptote" in v and curve.dimension == 2:  # the normal line
        d = [float(Fraction(p) - c) for p, c in zip(v["asymptote"]["point"], x)]
        check(abs(dot(d, map(float, first))) <= 1e-7 * data["scale"] * length(first), f"{where}: the asymptote is not the normal line")
        check(v["asymptote"]["direction"] == v["direction"], f"{where}: the asymptote's direction")
    spans = [s for s in curve.spans if s.contains(lo) and s.contains(hi)]
    check(any(s.bend_roots.within(s.local(lo), s.local(hi)) == 1 for s in spans), f"{where}: no inflection in [{lo}, {hi}]")


def check_ends_at_infinity(name, curve, data):
    """One for each place without curvature."""
    if any(s.squared_bend and (s.bend_roots.at(s.lo) or s.bend_roots.at(s.hi)) for pair in curve.joints() for s in pair[:2]):
        return  # at joints they may be one or two
    number = 0
    for span in curve.spans:
        number += span.bend_roots.inside(span.lo, span.hi)
    number += sum(span.bend_roots.at(z) for span, z, _ in curve.ends())
    said = sum(v["kind"] == "infinity" for v in data["vertices"])
    check(said == number, f"{name}: {said} ends at infinity, not {number}")


def check_evolute_arc(where, arc, curve, data):
    samples = arc["samples"]
    check(arc["inputs"] == [0] and arc["closed"] == ("source" not in arc) == ("target" not in arc), f"{where}: {arc['inputs']}")
    check(isinstance(arc["error"], (int, float)) and 0 < arc["error"] <= 1e-2 * data["cut_radius"], f"{where}: error {arc['error']}")
    check(len(samples) >= 2 and all(len(s["parameters"]) == 1 for s in samples), f"{where}: {len(samples)} samples")
    for s in samples[::max(1, len(samples) // 20)] + samples[-1:] + arc["irregular"]:
        check_centre(where, curve, data["scale"], parameter(s["parameters"][0]), s["point"], s["radius"])
    u = [parameter(s["parameters"][0]) for s in samples]
    falls = sum(b < a for a, b in zip(u, u[1:]))
    check(falls <= arc["closed"], f"{where}: parameters turn back")
    if arc["closed"]:
        check(curve.closed and math.dist(samples[0]["point"], samples[-1]["point"]) <= 1e-9 * data["scale"], f"{where}: does not close")
        return
    for key, s in (("source", samples[0]), ("target", samples[-1])):
        v = data["vertices"][arc[key]]
        if v["kind"] == "infinity":
            check(math.dist(s["point"], data["centre"]) >= data["cut_radius"] * (1 - 1e-6), f"{where}: cut inside the cut radius")
        elif "point" in v:
            check(math.dist(s["point"], v["point"]) <= 1e-9 * (data["scale"] + v["radius"]), f"{where}: its {key} is not its vertex")


def check_cusps(name, curve, data):
    """`irregular` is where the curvature is stationary, and at joints where its derivative changes its sign."""
    said = [parameter(p["parameters"][0]) for a in data["arcs"] for p in a["irregular"]]
    expected = []
    for span in curve.spans:
        for lo, hi in isolated(Roots(without(without(span.critical, span.speed), span.bend[0])), span):
            u = span.parameter((lo + hi) / 2)
            centre, _ = centre_of(*span.values(u))
            expected.append((float(u), math.dist(map(float, centre), data["centre"]) < data["cut_radius"] * 0.999))
    allowed = [u for u, _ in expected]
    for a, b, at in curve.joints():
        if not value(a.speed, a.hi) or not value(b.speed, b.lo):
            continue
        k, before, after = a.curvature_at(a.hi), sign_beside(a.curvature_slope, a.hi, -1), sign_beside(b.curvature_slope, b.lo, 1)
        if k and k == b.curvature_at(b.lo):
            allowed += map(float, at)
            t, r = (s.values(s.parameter(z))[1] for s, z in ((a, a.hi), (b, b.lo)))
            if before * after < 0 and t[0] * r[1] == t[1] * r[0] and dot(t, r) > 0:
                centre, _ = centre_of(*a.values(a.parameter(a.hi)))
                if math.dist(map(float, centre), data["centre"]) < data["cut_radius"] * 0.999:
                    check(any(same_place(u, float(x)) for u in said for x in at), f"{name}: no cusp at the joint {at}")
    for u in said:
        check(any(same_place(u, a) for a in allowed), f"{name}: a cusp at {u}, where the curvature is not stationary ({allowed})")
    for u, near in expected:
        check(not near or any(same_place(u, a) for a in said), f"{name}: no cusp at {u}")


def same_place(u, v):
    return u == v or math.isinf(u) and abs(v) > 1e9 or abs(u - v) <= 1e-9 * (1 + abs(u))


def isolated(roots, span):
    """Narrow intervals around the roots inside a span."""
    out, todo = [], [(span.lo, span.hi)]
    while todo:
        lo, hi = todo.pop()
        number = roots.inside(lo, hi)
        middle = (lo + hi) / 2
        if number and (number > 1 or hi - lo > LEAST):
            if roots.at(middle):
                out.append((middle, middle))
            todo += [(lo, middle), (middle, hi)]
        elif number:
            out.append((lo, hi))
    return out


def distance_to_segment(p, a, b):
    d, e = minus(b, a), minus(p, a)
    size = dot(d, d)
    t = min(1, max(0, dot(d, e) / size)) if size else 0
    return math.hypot(*(x - t * y for x, y in zip(e, d)))


def check_drawn(name, curve, data):
    """Every centre of curvature within the cut radius is near what is drawn."""
    polylines = [([s["point"] for s in a["samples"]], a["error"]) for a in data["arcs"]]
    isolated_points = [v["point"] for v in data["vertices"] if v["kind"] == "isolated"]
    for span in curve.spans:
        for n in range(1, 12):
            z = span.lo + (span.hi - span.lo) * Fraction(n, 12)
            x, first, second = span.values(span.parameter(z))
            centre = centre_of(x, first, second)[0] if dot(first, first) else None
            if centre is None or math.dist(map(float, centre), data["centre"]) >= data["cut_radius"]:
                continue
            p = list(map(float, centre))
            near = any(math.dist(p, q) <= 1e-9 * data["scale"] for q in isolated_points)
            near = near or any(distance_to_segment(p, a, b) <= error * (1 + 1e-9) for points, error in polylines for a, b in zip(points, points[1:]))
            check(near, f"{name}: {p} is on the evolute and far from all arcs")


# -------------------------------------------------------------------------------------------------------- surfaces


class Surface:
    """A tensor-product surface, evaluated from its control points."""

    def __init__(self, data):
        d = data["degrees"]
        points = data["control_points"]
        weights = data.get("weights", [[1] * len(row) for row in points])
        grid = [[[exact(c) * exact(w) for c in p] + [exact(w)] for p, w in zip(*rows)] for rows in zip(points, weights)]
        knots = [[exact(k) for k in ks] for ks in data.get("knots", [[0] * (n + 1) + [1] * (n + 1) for n in d])]
        rows, columns = len(grid), len(grid[0])

        def spans(k, n):
            return [i for i in range(d[k], n) if knots[k][i] < knots[k][i + 1]]

        def forms(row, k, i):
            lo, hi = knots[k][i], knots[k][i + 1]
            return [polar_form(row, knots[k], d[k], i, [lo] * (d[k] - j) + [hi] * j) for j in range(d[k] + 1)]

        self.patches = []
        for i in spans(0, rows):
            for j in spans(1, columns):
                patch = []
                for c in range(4):
                    along = [forms([grid[r][s][c] for s in range(columns)], 1, j) for r in range(rows)]
                    patch.append([forms(list(column), 0, i) for column in zip(*along)])
                self.patches.append(((knots[0][i], knots[0][i + 1]), (knots[1][j], knots[1][j + 1]), patch))

    def at(self, u, v):
        """Point and both tangents' directions."""
        (a, b), (c, d), patch = next(p for p in self.patches if p[0][0] <= u <= p[0][1] and p[1][0] <= v <= p[1][1])
        s, t = (Fraction(u) - a) / (b - a), (Fraction(v) - c) / (d - c)
        values, slopes = zip(*(casteljau_of_columns(form, s, t) for form in patch))
        w = values[3]
        return [x / w for x in values[:3]], [[(slopes[k][m] * w - values[k] * slopes[3][m]) for k in range(3)] for m in range(2)]


def casteljau_of_columns(columns, s, t):
    """Columns run with the first parameter."""
    along = [casteljau(column, s) for column in columns]
    x, across = casteljau([a[0] for a in along], t)
    return x, (casteljau([a[1] for a in along], t)[0], across)


# ----------------------------------------------------------------------------------------------- bisectors in space

SHEET_KEYS = ["euler", "error", "boundary", "points", "parameters", "radius", "triangles"]


class Foot:
    """An input of a job: feet on it are told by so many parameters."""

    def __init__(self, data):
        self.point = [exact(x) for x in data["point"]] if "point" in data else None
        self.curve = Curve(data["curve"]) if "curve" in data else None
        self.surface = Surface(data["surface"]) if "surface" in data else None
        self.parameters = 0 if self.point else 1 if self.curve else 2

    def at(self, u):
        """The foot and directions across which it is seen, of both sides of a joint."""
        if self.point:
            return [(self.point, [])]
        if self.curve:
            return [(x, [first]) for x, first, _ in self.curve.sides(u[0] if math.isinf(u[0]) else Fraction(u[0]))]
        return [self.surface.at(*map(Fraction, u))]

    def rough(self, u):
        if self.point:
            return list(map(float, self.point)), []
        if self.curve:
            x, tangent = self.curve.rough(u[0])
            return x, [tangent]
        x, tangents = self.surface.at(*u)
        return list(map(float, x)), [list(map(float, t)) for t in tangents]


def split(feet, u):
    out, at = [], 0
    for f in feet:
        out.append(u[at:at + f.parameters])
        at += f.parameters
    return out


def check_sheet(where, sheet, feet, data, limited):
    check(list(sheet) == SHEET_KEYS, f"{where}: keys {list(sheet)}")
    points, n = sheet["points"], len(sheet["points"])
    check(len(sheet["parameters"]) == len(sheet["radius"]) == n and all(len(p) == 3 for p in points), f"{where}: lists of different lengths")
    # Where the cells were limited, the error says how far they went.
    limit = math.inf if limited else data["tolerance"] * data["scale"] * (1 + 1e-6)
    check(isinstance(sheet["error"], (int, float)) and 0 < sheet["error"] < limit, f"{where}: error {sheet['error']}")
    check_topology(where, sheet)
    every = max(1, n // 60)
    for i, (p, u, radius) in enumerate(zip(points, sheet["parameters"], sheet["radius"])):
        u = list(map(parameter, u))
        if not check(len(u) == sum(f.parameters for f in feet), f"{where}: parameters {u}"):
            break
        allowed = 1e-9 * max(data["scale"], radius)
        if not check_feet(f"{where}: point {i}", feet, p, u, radius, allowed, i % every == 0):
            break


def check_feet(where, feet, p, u, radius, allowed, exactly):
    for f, own in zip(feet, split(feet, u)):
        if exactly:
            sides = [(minus(map(Fraction, p), x), tangents) for x, tangents in f.at(own)]
        else:
            x, tangents = f.rough(own)
            sides = [(minus(p, x), tangents)]
        off = min(abs(length(d) - radius) for d, _ in sides)
        if not check(off <= allowed, f"{where}: off by {off:.3g} from its foot at {own}"):
            return False
        off = min(max((abs(float(dot(d, t))) / (length(t) or 1) for t in tangents), default=0) for d, tangents in sides)
        if not check(off <= 10 * allowed, f"{where}: off by {off:.3g} from the normal at {own}"):
            return False
    return True


def check_topology(where, sheet):
    n, sides, loops = len(sheet["points"]), {}, {}
    for a, b, c in sheet["triangles"]:
        check(len({a, b, c}) == 3, f"{where}: a triangle {a, b, c}")
        for i, j in ((a, b), (b, c), (c, a)):
            sides.setdefault((min(i, j), max(i, j)), []).append(i < j)
    for loop in sheet["boundary"]:
        check(loop["kind"] in ("domain", "infinity", "singular", "trim", "undecided"), f"{where}: boundary {loop['kind']}")
        for i, j in zip(loop["loop"], loop["loop"][1:] + loop["loop"][:1]):
            loops[min(i, j), max(i, j)] = loops.get((min(i, j), max(i, j)), 0) + 1
    free = {e for e, s in sides.items() if len(s) == 1}
    check(all(len(s) == 1 or len(s) == 2 and s[0] != s[1] for s in sides.values()), f"{where}: an edge of three triangles, or two that turn against each other")
    check(set(loops) == free and all(m == 1 for m in loops.values()), f"{where}: {len(free)} free edges, {len(loops)} in loops")
    check(set(range(n)) == {i for e in sides for i in e}, f"{where}: points without a triangle, or triangles without a point")
    check(sheet["euler"] == n - len(sides) + len(sheet["triangles"]), f"{where}: euler {sheet['euler']}")
    parent = list(range(n))

    def find(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for i, j in sides:
        parent[find(i)] = find(j)
    check(len({find(i) for i in range(n)}) == 1, f"{where}: not connected")


def check_space_bisector(name, text, *arguments, statuses=(0, 1)):
    data = answer(name, text, *arguments, statuses=statuses)
    if data is None:
        return None
    feet = [Foot(i) for i in inputs_of(text)]
    keys = [k for k in cli_test.KEYS]
    keys[keys.index("regions"):keys.index("regions")] = ["sheets"] + (["rational"] if "rational" in data else [])
    check(list(data) == keys and data["compute"] == "bisector" and data["trimmed"] is json.loads(text).get("options", {}).get("trimmed", True), f"{name}: keys {list(data)}")
    check(data["arcs"] == [], f"{name}: {len(data['arcs'])} arcs")
    check_scale(name, feet, data)
    check(data["components"] == len(data["sheets"]), f"{name}: {data['components']} components of {len(data['sheets'])} sheets")
    for i, sheet in enumerate(data["sheets"]):
        check_sheet(f"{name}: sheets[{i}]", sheet, feet, data, "--max-cells" in arguments)
    check(bool(data["undecided"]) >= any(b["kind"] == "undecided" for s in data["sheets"] for b in s["boundary"]), f"{name}: an undecided end of nothing undecided")
    for i, piece in enumerate(data.get("rational", [])):
        check_rational_surface(f"{name}: rational[{i}]", piece, feet, data)
    return data


FRACTIONS = [Fraction(1, 9), Fraction(2, 5), Fraction(4, 7), Fraction(10, 11)]


def check_rational_surface(where, piece, feet, data):
    check_form(where, piece)
    meshes = [Mesh(s) for s in data["sheets"]]
    coordinates = {0, 1, 2}
    for s in FRACTIONS:
        for t in FRACTIONS[::-1]:
            b = exact_image(piece, [s, t])
            if b is None:
                continue
            u = pieces_at(piece, [s, t])
            own = u
            if sum(f.parameters for f in feet) == 1:  # the second parameter is a coordinate
                coordinates = {k for k in coordinates if b[k] == u[1]}
                own = u[:1]
            elif not any(f.parameters for f in feet):
                own = []
            squares = []
            for f, at in zip(feet, split(feet, own)):
                x, tangents = f.at(at)[0]
                d = minus(b, x)
                squares.append(dot(d, d))
                check(all(dot(d, tangent) == 0 for tangent in tangents), f"{where}: at {u} not on the normal of {at}")
            check(squares[0] == squares[1], f"{where}: at {u} not equally far")
            if math.dist(map(float, b), data["centre"]) < 0.99 * data["cut_radius"] and not data["undecided"]:
                p = list(map(float, b))
                check(any(m.is_near(p) for m in meshes), f"{where}: {p} at {u} is far from all sheets")
    if sum(f.parameters for f in feet) == 1:
        check(coordinates, f"{where}: the second parameter is no coordinate")


class Mesh:
    """Triangles of a sheet, asked for their distance."""

    def __init__(self, sheet):
        self.error = sheet["error"] * (1 + 1e-9)
        self.triangles = []
        for t in sheet["triangles"]:
            corners = [sheet["points"][i] for i in t]
            x = [c[0] for c in corners]
            self.triangles.append((min(x) - self.error, max(x) + self.error, corners))

    def is_near(self, p):
        for lo, hi, corners in self.triangles:
            if lo <= p[0] <= hi and all(min(c[k] for c in corners) - self.error <= p[k] <= max(c[k] for c in corners) + self.error for k in (1, 2)):
                if distance_to_triangle(p, *corners) <= self.error:
                    return True
        return False


def distance_to_triangle(p, a, b, c):
    normal = cross(minus(b, a), minus(c, a))
    size = math.hypot(*normal)
    if size > 0 and all(dot(cross(minus(j, i), minus(p, i)), normal) >= 0 for i, j in ((a, b), (b, c), (c, a))):
        return abs(dot(minus(p, a), normal)) / size
    return min(distance_to_segment(p, i, j) for i, j in ((a, b), (b, c), (c, a)))


def space_job(*inputs, **options):
    return json.dumps({"compute": "bisector", "inputs": list(inputs), "options": dict({"trimmed": False}, **options)})


HALF_ELLIPSE = {"curve": {"monomial": {"x": [2, 0, -2], "y": [0, 2], "z": [0], "w": [1, 0, 1]}, "domain": ["-inf", "inf"]}}
SPLINE = {"curve": {"degree": 2, "control_points": [[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 3]], "knots": [0, 0, 0, 1, 2, 2, 2]}}
SKEW_LINE = {"curve": {"degree": 1, "control_points": [[0, 4, 2], [4, 5, 3]]}}
SADDLE = {"surface": {"degrees": [1, 1], "control_points": [[[0, 0, 0], [0, 1, 1]], [[1, 0, 1], [1, 1, 0]]], "weights": [[1, 2], [1, 1]]}}
SPLINE_SURFACE = {"surface": {"degrees": [2, 1], "control_points": [[[0, 0, 0], [0, 2, 0]], [[1, 0, 1], [1, 2, 1]], [[2, 0, 1], [2, 2, 2]], [[3, 0, 0], [3, 2, 0]]],
                              "knots": [[0, 0, 0, 1, 2, 2, 2], [0, 0, 1, 1]]}}


def P(*x):
    return {"point": list(x)}


# name, job, number of exact pieces if it is to be checked
SPACE_JOBS = [
    ("a point and a whole ellipse", space_job(P("1/2", 0, 1), HALF_ELLIPSE), None),
    ("a point and a spline", space_job(SPLINE, P(1, 1, 4)), None),
    ("a point and a line", space_job(P(0, 0, 2), {"curve": {"degree": 1, "control_points": [[-1, 0, 0], [1, 0, 0]]}}), None),
    ("a spline and a line", space_job(SPLINE, SKEW_LINE), 2),
    ("a line and a spline", space_job(SKEW_LINE, SPLINE), 2),
    ("a point and a saddle", space_job(SADDLE, P(0, 0, 2)), 1),
    ("a point and a spline surface", space_job(P(1, 1, 4), SPLINE_SURFACE), 2),
    ("a point and a plane", space_job(P(0, 0, "3/2"), {"surface": {"degrees": [1, 1], "control_points": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]}}), 1),
    ("two points, far apart", space_job(P("-1/3", 0, 1e3), P(1, 2, -5)), 1),
]


def test_space_bisectors(folder):
    for path in sorted(glob.glob(os.path.join(JOBS, "space", "*.json"))):
        name = os.path.basename(path)
        with open(path) as f:
            text = f.read()
        if json.loads(text)["compute"] == "bisector":
            data = check_space_bisector(name, text, "--tolerance", "0.3" if name == "two_cubics.json" else "0.05")
            check(data is not None and data["status"] == "certified" and data["sheets"], f"{name}: {data and data['status']}")
            check(data is None or ("rational" in data) != (name == "coplanar_curves.json"), f"{name}: rational")
    for name, text, number in SPACE_JOBS:
        data = check_space_bisector(name, text, "--tolerance", "0.05", statuses=(0,))
        check(data is None or data["sheets"], f"{name}: nothing drawn")
        check(data is None or number is None or len(data["rational"]) == number, f"{name}: exact pieces")
    # Two points have one bisector, trimmed or not.
    text = space_job(P(0, 0, 0), P(1, 0, 2), trimmed=True)
    check_space_bisector("trimmed, of two points", text, statuses=(0,))
    # On one line all normal planes are parallel.
    data = check_space_bisector("two lines on one", space_job(cli_test.SPACE, cli_test.SPACE), statuses=(0,))
    check(data is None or data["sheets"] == [] and data["degenerate"][0]["kind"] == "everything", "two lines on one")
    # A limit that is reached is said.
    data = answer("few cells", space_job(SPLINE, SKEW_LINE), "--max-cells", "20", statuses=(1,))
    check(data is None or data["undecided"] and all(u["reason"] for u in data["undecided"]), "a limit was reached, but nothing is undecided")
    test_mesh_files(folder)


def test_mesh_files(folder):
    names = {kind: os.path.join(folder, "out." + kind) for kind in ("json", "ply", "obj", "vtk")}
    for name, text in (("spline and line", space_job(SPLINE, SKEW_LINE)), ("point and ellipse", space_job(P("1/2", 0, 1), HALF_ELLIPSE))):
        arguments = [word for kind, file in names.items() for word in ("--" + kind, file)]
        result = run(["-", "--tolerance", "0.1", *arguments], stdin=text.encode())
        if not check(result.returncode == 0 and result.stdout == b"", f"meshes of {name}: {result.returncode} {result.stderr[:300]!r}"):
            continue
        lines = {}
        for kind, file in names.items():
            with open(file) as f:
                lines[kind] = f.read().split("\n")
        data = read_result("\n".join(lines["json"]))
        points = [p for s in data["sheets"] for p in s["points"]]
        triangles, first = [], 0
        for s in data["sheets"]:
            triangles += [[first + i for i in t] for t in s["triangles"]]
            first += len(s["points"])
        check(len(data["sheets"]) >= 1 and triangles, f"meshes of {name}: none")
        compare_meshes(name, lines, points, triangles)


def compare_meshes(name, lines, points, triangles):
    words = {kind: [line.split() for line in text if line] for kind, text in lines.items()}
    vertices = [list(map(float, w[1:])) for w in words["obj"] if w[0] == "v"]
    faces = [[int(x) - 1 for x in w[1:]] for w in words["obj"] if w[0] == "f"]
    check(vertices == points and faces == triangles, f"OBJ of {name}: {len(vertices)} vertices, {len(faces)} triangles; {len(points)}, {len(triangles)}")
    head = words["ply"].index(["end_header"]) + 1
    check(["element", "vertex", str(len(points))] in words["ply"] and ["element", "face", str(len(triangles))] in words["ply"], f"PLY of {name}: its head")
    body = words["ply"][head:]
    vertices = [list(map(float, w[:3])) for w in body[:len(points)]]
    faces = [list(map(int, w)) for w in body[len(points):]]
    check(vertices == points and faces == [[3] + t for t in triangles], f"PLY of {name}: {len(body)} lines")
    at = next(i for i, w in enumerate(words["vtk"]) if w[0] == "POINTS")
    check(words["vtk"][at][1] == str(len(points)), f"VTK of {name}: {words['vtk'][at]}")
    vertices = [list(map(float, w)) for w in words["vtk"][at + 1:at + 1 + len(points)]]
    at += 1 + len(points)
    check(words["vtk"][at][:2] == ["POLYGONS", str(len(triangles))], f"VTK of {name}: {words['vtk'][at]}")
    faces = [list(map(int, w)) for w in words["vtk"][at + 1:at + 1 + len(triangles)]]
    check(vertices == points and faces == [[3] + t for t in triangles], f"VTK of {name}: its lists")


def random_inputs(rng):
    def point():
        return [rng.randint(-8, 8) / 2 for _ in range(3)]

    def curve():
        degree = rng.randint(1, 2)
        data = bezier([point() for _ in range(degree + 1)])
        if rng.random() < 0.3:
            data["weights"] = [rng.choice([1, 2, 3]) for _ in range(degree + 1)]
        return {"curve": data}

    def surface():
        degrees = [rng.randint(1, 2), 1]
        return {"surface": {"degrees": degrees, "control_points": [[point() for _ in range(2)] for _ in range(degrees[0] + 1)]}}

    other = rng.choice([curve, curve, surface])
    inputs = [P(*point()), other()] if rng.random() < 0.7 else [curve(), curve()]
    return inputs if rng.random() < 0.5 else inputs[::-1]


def test_random_inputs():
    seed = int(os.environ.get("LOCUS_TEST_SEED", "1"))
    answered = 0
    for i in range(16):
        rng = random.Random(1000 * seed + i)
        text = space_job(*random_inputs(rng))
        # Few cells: what is left is undecided, and what is drawn is right all the same.
        data = check_space_bisector(f"LOCUS_TEST_SEED={seed}, job {i} {text}", text, "--tolerance", "0.1", "--max-cells", "3000", statuses=(0, 1, 2, 4))
        answered += data is not None
    check(answered >= 12, f"only {answered} of 16 random jobs in space were answered")


def main():
    if not os.access(PROGRAM, os.X_OK):
        print(f"{PROGRAM} is not there: build the target locus_cli first")
        return 1
    test_curvature()
    test_evolutes()
    test_pictures()
    test_random_curves()
    with tempfile.TemporaryDirectory() as folder:
        test_space_bisectors(folder)
    test_random_inputs()
    return cli_test.report()


if __name__ == "__main__":
    sys.exit(main())
