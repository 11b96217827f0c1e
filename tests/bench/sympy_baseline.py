#!/usr/bin/env python3
"""The propagation procedure of ParSEL (§5, supplement §4, algorithms 2 and 3) as the paper describes it, with SymPy.

For every part to edit: each candidate (operator x 27 points x global and local axes x features, merged when their
displacement fields are equal up to scale) is applied with an unknown amount Y, each scalar constraint equation goes
through sympy.solve for Y on its own, and every solution is checked on all constraints at 50 random values of x. It runs
on the same shape (`parsel inspect`) and the same edit (format parsel/edit v1) as bench_propagate, in one process.

    parsel inspect chair.glb -o chair.json
    /usr/bin/python3 sympy_baseline.py chair.json widen.json [--sample 3] [--seconds 600] [--parts 2] [--seed 1]

Prints CSV: benchmark,case,metric,value. Solving everything takes hours, so with --sample N only N candidates of each
operator (drawn at random) are worked on at every part, and the time of that operator is scaled by how many it has. The
line `extrapolated` then is 1, `seconds` is the estimate and `seconds_measured` what was really spent. --sample 0 works on
all. --parts N stops after N solved parts, --seconds after that much algebra (`finished` is 0 in both cases, and `seconds` that of
what was done). Which edit the search goes on with is found by a numeric screen, whose time is not
counted: only the algebra is.

Left out, to the baseline's advantage: ARAP energies, neighbour edits, breaking edits, change_count and change_delta. A
part without a solution stays fixed. Needs only SymPy (Debian: python3-sympy).
"""
import argparse
import itertools
import json
import math
import random
import sys
import time

import sympy

X, Y = sympy.Symbol("x", real=True), sympy.Symbol("Y", real=True)
TAU, ONE_EDITED, EXACT, SAMPLES = 0.35, 0.0144, 0.002, 50
LINEAR = ("translate", "scale_1d", "scale_2d", "scale_3d", "shear")
TRIPLES = list(itertools.product((-1, 0, 1), repeat=3))


def add(a, b): return [p + q for p, q in zip(a, b)]
def sub(a, b): return [p - q for p, q in zip(a, b)]
def mul(s, a): return [s * p for p in a]
def dot(a, b): return sum(p * q for p, q in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return mul(1 / math.sqrt(dot(a, a)), a)
def sign(k, axis): return 1 if k >> axis & 1 else -1
def selected(k, feature): return all(f in (0, sign(k, i)) for i, f in enumerate(feature))
def weights(u): return [math.prod((1 + sign(k, i) * u[i]) / 2 for i in range(3)) for k in range(8)]
def blend(w, corners): return [sum(w[k] * corners[k][i] for k in range(8) if w[k]) for i in range(3)]


def operate(op, p, amount, origin, direction, normal, cos, sin):
    """Supplement, table 2; `cos` and `sin` are those of the amount, so that numbers and symbols share this."""
    if op == "translate":
        return add(p, mul(amount, direction))
    r = sub(p, origin)
    if op == "rotate":
        along = mul(dot(direction, r), direction)
        return add(add(origin, along), add(mul(cos, sub(r, along)), mul(sin, cross(direction, r))))
    if op == "scale_1d":
        return add(p, mul(amount * dot(direction, r), direction))
    if op == "scale_2d":
        return add(p, mul(amount, sub(r, mul(dot(normal, r), normal))))
    if op == "scale_3d":
        return add(p, mul(amount, r))
    return add(p, mul(amount * dot(normal, r), direction))  # shear


def apply(edit, corners, amount):
    op, feature, origin, direction, normal = edit
    if isinstance(amount, float):
        cos, sin = math.cos(amount), math.sin(amount)
    else:
        cos, sin = (sympy.cos(amount), sympy.sin(amount)) if op == "rotate" else (None, None)
    return [operate(op, c, amount, origin, direction, normal, cos, sin) if selected(k, feature) else c
            for k, c in enumerate(corners)]


def candidates(part):
    """All of the paper's candidates for a part at rest, merged by displacement field. Yields (op, feature, o, d, n)."""
    corners = part["corners"]
    points = [blend(weights(t), corners) for t in TRIPLES]
    axes = []
    for axis in [[1, 0, 0], [0, 1, 0], [0, 0, 1]] + part["axes"]:
        if all(abs(abs(dot(axis, other)) - 1) > 1e-9 for other in axes):
            axes.append([float(c) for c in axis])
    zero, seen, result = [0.0] * 3, set(), []
    parameters = [("translate", zero, d, zero) for d in axes]
    parameters += [("rotate", o, d, zero) for o in points for d in axes]
    parameters += [("scale_1d", o, d, zero) for o in points for d in axes]
    parameters += [("scale_2d", o, zero, n) for o in points for n in axes]
    parameters += [("scale_3d", o, zero, zero) for o in points]
    parameters += [("shear", o, d, n) for o in points for d in axes for n in axes if abs(dot(d, n)) < 1e-9]
    for feature in sorted(TRIPLES, key=lambda t: sum(map(abs, t))):
        for op, origin, direction, normal in parameters:
            edit = (op, feature, origin, direction, normal)
            field = [c for a, b in zip(apply(edit, corners, 0.5), corners) for c in sub(a, b)]
            size = max(map(abs, field))
            if size < 1e-9:
                continue
            first = next(c for c in field if abs(c) > 1e-6 * size)
            key = (op == "rotate",) + tuple(round(c / (first if op != "rotate" else 1.0), 5) + 0.0 for c in field)
            if key not in seen:
                seen.add(key)
                result.append(edit)
    return result


class Baseline:
    def __init__(self, shape, edit, options):
        self.options, self.random = options, random.Random(options.seed)
        self.parts = {p["id"]: p for p in shape["parts"]}
        members = {m for p in shape["parts"] if p["virtual"] for m in p["members"]}
        self.active = [p for p in self.parts if p not in members]
        disabled = set(edit.get("disabled", []))
        self.relations = [r for r in shape["relations"]
                          if r["kind"] not in ("translation", "rotation") and r["id"] not in disabled
                          and "kind:" + r["kind"] not in disabled and all(p in self.active for p in r["parts"])]
        self.corners = {p: self.parts[p]["corners"] for p in self.active}  # expressions of x once edited
        self.edits = {}
        for s in edit["seed"]:
            edit_, amount = self.statement(s)
            self.corners[s["part"]] = apply(edit_, self.corners[s["part"]], amount)
            self.edits.setdefault(s["part"], []).append((edit_, amount))
        self.count = {"parts": 0, "candidates": 0, "equations": 0, "solves": 0}
        self.measured = self.seconds = 0.0
        self.extrapolated, self.finished = False, True
        self.began = time.process_time()

    def statement(self, s):
        def point(ref):
            return blend(weights(ref["at"]), self.parts[ref["part"]]["corners"]) if isinstance(ref, dict) else ref

        def direction(ref):
            return unit(self.parts[ref["part"]]["axes"][ref["axis"]] if isinstance(ref, dict) else ref)
        zero = [0.0] * 3
        return ((s["op"], s.get("feature", [0, 0, 0]), point(s.get("origin", zero)),
                 direction(s["axis"] if "axis" in s else s["direction"]) if "axis" in s or "direction" in s else zero,
                 direction(s["normal"]) if "normal" in s else zero),
                sympy.sympify(s["amount"].replace("^", "**"), locals={"x": X}))

    def constraint(self, relation, part, corners):
        """C(x) of a relation as scalar expressions, with `corners` for the part. Paper §5.2, supplement table 1."""
        a, b = relation["parts"]
        state = {a: self.corners[a], b: self.corners[b], part: corners}
        if relation["kind"] == "reflection":
            n, o, result = relation["normal"], relation["origin"], []
            for k in range(8):
                image = state[a][relation["corner_map"][k]]
                mirrored = sub(image, mul(2 * dot(sub(image, o), n), n))
                result += sub(state[b][k], mirrored)
            return result
        result = []
        for ua, ub in zip(relation["local_a"], relation["local_b"]):
            wa, wb = weights(ua), weights(ub)
            rest = sub(blend(wa, self.parts[a]["corners"]), blend(wb, self.parts[b]["corners"]))
            result += sub(sub(blend(wa, state[a]), blend(wb, state[b])), rest)
        return result

    @staticmethod
    def worst(expressions, values):
        expressions = [e for e in expressions if not isinstance(e, (int, float))] or [0]
        function = sympy.lambdify(X, expressions, "math")
        try:
            return max(abs(v) for x in values for v in function(x))
        except (ValueError, ZeroDivisionError, OverflowError, TypeError):
            return math.inf

    def broken(self):
        """Broken relations of every unedited part with edited ones."""
        values = [self.random.uniform(0, TAU) for _ in range(SAMPLES)]
        result = {}
        for relation in self.relations:
            a, b = relation["parts"]
            if (a in self.edits) == (b in self.edits):
                continue
            part = b if a in self.edits else a
            if self.worst(self.constraint(relation, part, self.corners[part]), values) > ONE_EDITED:
                result.setdefault(part, []).append(relation)
        return result

    def mirrored_edit(self, part, relations):
        """E* = T(E): symmetry has a known solution (paper §5.3)."""
        for relation in relations:
            if relation["kind"] != "reflection":
                continue
            other = next(p for p in relation["parts"] if p != part)
            n, o = relation["normal"], relation["origin"]
            to_other = relation["corner_map"] if relation["parts"][1] == part else \
                [relation["corner_map"].index(k) for k in range(8)]
            images = [self.corners[other][to_other[k]] for k in range(8)]
            return [sub(c, mul(2 * dot(sub(c, o), n), n)) for c in images]
        return None

    def constraints(self, part, corners):
        return [c for r in self.relations if part in r["parts"] and any(p in self.edits for p in r["parts"] if p != part)
                for c in self.constraint(r, part, corners)]

    def work(self, part, edit):
        """One candidate, as in algorithm 3: solve every equation for Y on its own, check every solution."""
        start = time.process_time()
        rest = self.parts[part]["corners"]
        equations = self.constraints(part, apply(edit, rest, Y))
        solutions = set()
        for equation in equations:
            equation = sympy.sympify(equation)
            if not equation.has(Y):
                continue
            self.count["solves"] += 1
            try:
                solutions.update(s for s in sympy.solve(equation, Y) if s.has(X))
            except NotImplementedError:
                pass
        accepted = []
        for solution in solutions:
            values = [self.random.uniform(0, TAU) for _ in range(SAMPLES)]
            if self.worst([sympy.sympify(e).subs(Y, solution) for e in equations], values) <= ONE_EDITED:
                accepted.append(solution)
        self.count["equations"] += len(equations)
        return time.process_time() - start, accepted

    def fits(self, part, edit):
        """Numeric screen, not part of the paper: largest miss of the best amounts at four values of x."""
        rest, worst = self.parts[part]["corners"], 0.0
        for x in (0.1, 0.2, 0.3, 0.35):
            def miss(amount):
                moved = apply(edit, rest, amount)
                return [float(v) for v in self.numeric(part, moved, x)]
            at_rest, step = miss(0.0), 1e-3
            if edit[0] != "rotate":
                slope = mul(1000, sub(miss(step), at_rest))
                size = dot(slope, slope)
                if size < 1e-12:
                    return math.inf
                worst = max(worst, max(map(abs, miss(-dot(slope, at_rest) / size))))
                continue
            amount = 0.0
            for _ in range(6):  # Gauss-Newton
                now = miss(amount)
                slope = mul(1000, sub(miss(amount + step), now))
                size = dot(slope, slope)
                if size < 1e-12:
                    return math.inf
                amount -= dot(slope, now) / size
                if abs(amount) > 3:
                    return math.inf
            worst = max(worst, max(map(abs, miss(amount))))
        return worst

    def numeric(self, part, corners, x):
        key = (part, x, len(self.edits))
        if key not in self.cache:
            zero = [[0.0] * 3] * 8
            function = sympy.lambdify(X, self.constraints(part, zero), "math")
            self.cache[key] = function(x)
        known, result, i = self.cache[key], [], 0
        for r in self.relations:
            if part not in r["parts"] or not any(p in self.edits for p in r["parts"] if p != part):
                continue
            # Linear in the part's own corners: add their share to what the others give.
            mine = r["parts"].index(part)
            if r["kind"] == "reflection":
                n = r["normal"]
                for k in range(8):
                    own = corners[k] if mine else corners[r["corner_map"][k]]
                    result += add(known[i:i + 3], own if mine else mul(-1, sub(own, mul(2 * dot(own, n), n))))
                    i += 3
                continue
            for u in r["local_b" if mine else "local_a"]:
                result += add(known[i:i + 3], mul(-1 if mine else 1, blend(weights(u), corners)))
                i += 3
        return result

    def solve_part(self, part):
        everything = candidates(self.parts[part])
        self.count["parts"] += 1
        self.count["candidates"] += len(everything)
        self.cache = {}
        ranked = sorted(((self.fits(part, e), sum(map(abs, e[1])), LINEAR.index(e[0]) if e[0] in LINEAR else 1, i)
                         for i, e in enumerate(everything)), key=lambda f: (f[0] > EXACT, f[0] > ONE_EDITED, f[1:]))
        chosen = None
        for op in ("rotate",) + LINEAR:
            pool = [e for e in everything if e[0] == op]
            if not pool:
                continue
            drawn = pool
            if self.options.sample and self.options.sample < len(pool):
                drawn, self.extrapolated = self.random.sample(pool, self.options.sample), True
            spent = 0.0
            for edit in drawn:
                if self.measured + spent > self.options.seconds:
                    self.finished = False
                    break
                spent += self.work(part, edit)[0]
            self.measured += spent
            self.seconds += spent * len(pool) / len(drawn)
            if not self.finished:
                return
        if ranked and ranked[0][0] <= ONE_EDITED:
            chosen = everything[ranked[0][3]]
        amounts = self.work(part, chosen)[1] if chosen else []
        if amounts:
            amount = min(amounts, key=lambda a: a.count_ops())
            self.corners[part] = apply(chosen, self.corners[part], amount)
            self.edits[part] = [(chosen, amount)]
        else:
            self.edits[part] = []
        what = f"{chosen[0]} {list(chosen[1])} by {amount}" if amounts else "keep_fixed"
        print(f"{part}: {what}", file=sys.stderr, flush=True)

    def run(self):
        while self.finished:
            broken = self.broken()
            if not broken:
                break
            part = min(broken, key=lambda p: (not any(r["kind"] == "reflection" for r in broken[p]), -len(broken[p]), p))
            mirrored = self.mirrored_edit(part, broken[part])
            if mirrored is not None:
                self.corners[part] = mirrored
                self.edits[part] = []
                print(f"{part}: mirrored", file=sys.stderr, flush=True)
                continue
            self.solve_part(part)
            if self.options.parts and self.count["parts"] >= self.options.parts and self.broken():
                self.finished = False


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("shape", help="what `parsel inspect` prints")
    parser.add_argument("edit", help="format parsel/edit v1")
    parser.add_argument("--sample", type=int, default=3, help="candidates of each operator and part; 0: all")
    parser.add_argument("--seconds", type=float, default=600, help="end the run after this processor time of algebra")
    parser.add_argument("--parts", type=int, default=0, help="end after this many solved parts; 0: all")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with open(options.shape, encoding="utf-8") as file:
        shape = json.load(file)
    with open(options.edit, encoding="utf-8") as file:
        edit = json.load(file)
    nodes = {f"node:{p['node']}": p["id"] for p in shape["parts"] if not p["virtual"]}
    for statement in edit["seed"]:  # a part may be named by its node
        for owner in (statement, *(v for v in statement.values() if isinstance(v, dict))):
            if "part" in owner:
                owner["part"] = nodes.get(owner["part"], owner["part"])
    baseline = Baseline(shape, edit, options)
    baseline.run()
    case = f"{shape['name']}/{options.edit.rsplit('/', 1)[-1].removesuffix('.json')}"
    rows = {**baseline.count, "seconds": round(baseline.seconds, 3), "seconds_measured": round(baseline.measured, 3),
            "extrapolated": int(baseline.extrapolated), "finished": int(baseline.finished)}
    print("benchmark,case,metric,value")
    for metric, value in rows.items():
        print(f"sympy_baseline,{case},{metric},{value}")


if __name__ == "__main__":
    main()
