"""Evaluates programs slowly and readably: the comment of core/edit/evaluate.h, sentence by sentence.

Vectors are lists of three floats, corners lists of eight of them. Amounts are evaluated by Python itself, which is safe
because the only programs it ever sees are those of program_cases.py.
"""
import copy
import math

FUNCTIONS = {"sqrt": math.sqrt, "abs": abs, "floor": lambda a: math.floor(a + 1e-9), "sin": math.sin, "cos": math.cos, "tan": math.tan,
             "atan2": math.atan2, "min": min, "max": max, "pi": math.pi, "__builtins__": {}}


def add(a, b): return [x + y for x, y in zip(a, b)]
def sub(a, b): return [x - y for x, y in zip(a, b)]
def mul(s, a): return [s * x for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def norm(a): return math.sqrt(dot(a, a))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def mean(points): return mul(1 / len(points), [sum(p[i] for p in points) for i in range(3)])
def sign(k, axis): return 1 if k >> axis & 1 else -1
def selected(k, feature): return all(f in (0, sign(k, i)) for i, f in enumerate(feature))
def move(corners, v): return [add(c, v) for c in corners]


def rotation_matrix(n, a):
    """cos·I + sin·[n]× + (1 - cos)·n nᵀ, the form in the supplement's table 2."""
    c, s = math.cos(a), math.sin(a)
    skew = [[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]]
    return [[(c if i == j else 0) + s * skew[i][j] + (1 - c) * n[i] * n[j] for j in range(3)] for i in range(3)]


def matrix_times(matrix, v): return [dot(row, v) for row in matrix]


def determinant(m): return dot(m[0], cross(m[1], m[2]))


def solve(m, v):
    """m·u = v by Cramer's rule; None when m is singular."""
    d = determinant(m)
    if abs(d) <= 1e-18:
        return None
    columns = [[row[j] for row in m] for j in range(3)]
    result = []
    for j in range(3):
        replaced = [list(v) if i == j else columns[i] for i in range(3)]
        result.append(determinant(replaced) / d)  # the determinant of a matrix is that of its transpose
    return result


def feature_point(corners, at): return mean([c for k, c in enumerate(corners) if selected(k, at)])


def axis_direction(corners, axis):
    plus = [1 if i == axis else 0 for i in range(3)]
    d = sub(feature_point(corners, plus), feature_point(corners, [-x for x in plus]))
    return None if norm(d) < 1e-12 else mul(1 / norm(d), d)


def weights(u): return [math.prod(0.5 * (1 + sign(k, i) * u[i]) for i in range(3)) for k in range(8)]


def local_coordinates(corners, point):
    centre = mean(corners)
    half = []
    for axis in range(3):
        plus = [1 if i == axis else 0 for i in range(3)]
        half.append(mul(0.5, sub(feature_point(corners, plus), feature_point(corners, [-x for x in plus]))))
    guess = solve([[half[j][i] for j in range(3)] for i in range(3)], sub(point, centre))
    if guess is None:
        return [0, 0, 0]
    u = guess
    for _ in range(32):
        w = weights(u)
        here = [sum(w[k] * corners[k][i] for k in range(8)) for i in range(3)]
        jacobian = [[0.0] * 3 for _ in range(3)]
        for k in range(8):
            for j in range(3):
                d = 0.5 * sign(k, j) * math.prod(0.5 * (1 + sign(k, i) * u[i]) for i in range(3) if i != j)
                for i in range(3):
                    jacobian[i][j] += d * corners[k][i]
        step = solve(jacobian, sub(point, here))
        if step is None:
            return guess
        u = add(u, step)
        if max(abs(s) for s in step) <= 1e-12:
            return u
    return guess


class State:
    def __init__(self, shape):
        self.parts = {p["id"]: copy.deepcopy(p["corners"]) for p in shape["parts"]}
        self.groups = {}
        for r in shape["relations"]:
            if r["kind"] not in ("translation", "rotation"):
                continue
            group = {"instances": [copy.deepcopy(self.parts[m]) for m in r["parts"]], "source": -1}
            for key in ("start", "end", "centre", "axis", "radius") if r["kind"] == "rotation" else ("start", "end"):
                if key in r:
                    group[key] = copy.deepcopy(r[key])
            self.groups[r["id"]] = group


class Reference:
    def __init__(self, shape):
        self.shape = shape
        self.relations = {r["id"]: r for r in shape["relations"]}
        self.rest = State(shape)

    def evaluate(self, program, values):
        names = {layer["parameter"]["name"]: v for layer, v in zip(program["layers"], values)}
        state = State(self.shape)
        for layer in program["layers"]:
            before = copy.deepcopy(state.parts)
            for statement in layer["statements"]:
                self.run(statement, names, before, state)
        return state

    def run(self, s, names, before, state):
        if s["op"] == "keep_fixed":
            return
        amount = eval(s["amount"].replace("^", "**"), FUNCTIONS, names)
        if s["op"] in ("change_count", "change_delta"):
            relation = self.relations[s["relation"]]
            change = {("change_count", "translation"): self.count_line, ("change_count", "rotation"): self.count_ring,
                      ("change_delta", "translation"): self.delta_line, ("change_delta", "rotation"): self.delta_ring}
            change[s["op"], relation["kind"]](relation, state, amount, s.get("anchor", "middle"))
            self.synchronise(relation, state)
            return

        def point(reference):
            if isinstance(reference, dict):
                return feature_point(before[self.part_id(reference["part"])], reference["at"])
            return reference

        def direction(reference):
            if isinstance(reference, dict):
                return axis_direction(before[self.part_id(reference["part"])], reference["axis"])
            return mul(1 / norm(reference), reference)

        o = point(s["origin"]) if "origin" in s else [0, 0, 0]
        d = direction(s["axis"] if "axis" in s else s["direction"]) if "axis" in s or "direction" in s else [0, 0, 0]
        n = direction(s["normal"]) if "normal" in s else [0, 0, 0]
        if d is None or n is None:
            return

        def operate(p):
            r = sub(p, o)
            if s["op"] == "translate":
                return add(p, mul(amount, d))
            if s["op"] == "rotate":
                return add(o, matrix_times(rotation_matrix(d, amount), r))
            if s["op"] == "scale_1d":
                return add(p, mul(amount * dot(d, r), d))
            if s["op"] == "scale_2d":
                return add(p, mul(amount, sub(r, mul(dot(n, r), n))))
            if s["op"] == "scale_3d":
                return add(o, mul(1 + amount, r))
            if s["op"] == "shear":
                return add(p, mul(amount * dot(n, r), d))
            raise ValueError(s["op"])

        feature = s.get("feature", [0, 0, 0])
        part = self.part_id(s["part"])

        def edited(corners):
            return [operate(c) if selected(k, feature) else c for k, c in enumerate(corners)]

        for relation in self.relations.values():
            if relation["kind"] not in ("translation", "rotation"):
                continue
            group = state.groups[relation["id"]]
            if part in relation["parts"]:
                i = relation["parts"].index(part)
                group["instances"][i] = edited(group["instances"][i])
                self.synchronise(relation, state)
                return
            if part == relation["parent"]:
                old = state.parts[part]
                new = edited(old)

                def carried(p):
                    if feature == [0, 0, 0]:
                        return operate(p)
                    w = weights(local_coordinates(old, p))
                    return [p[i] + sum(w[k] * (new[k][i] - old[k][i]) for k in range(8)) for i in range(3)]

                group["instances"] = [[carried(c) for c in instance] for instance in group["instances"]]
                state.parts[part] = new
                if relation["kind"] == "translation":
                    group["start"], group["end"] = carried(group["start"]), carried(group["end"])
                else:
                    group["centre"] = carried(group["centre"])
                    rest = axis_direction(self.rest.parts[part], relation["parent_axis"])
                    now = axis_direction(new, relation["parent_axis"])
                    if now is not None:
                        group["axis"] = mul(1 if dot(rest, relation["axis"]) > 0 else -1, now)
                    radii = [norm(self.spoke(group, instance)) for instance in group["instances"]]
                    group["radius"] = sum(radii) / len(radii)
                self.synchronise(relation, state)
                return
        state.parts[part] = edited(state.parts[part])

    def part_id(self, name):
        if name.startswith("node:"):
            return next(p["id"] for p in self.shape["parts"] if p["node"] == int(name[5:]))
        return name

    @staticmethod
    def synchronise(relation, state):
        instances = state.groups[relation["id"]]["instances"]
        for k, member in enumerate(relation["parts"]):
            state.parts[member] = instances[min(k, len(instances) - 1)]

    @staticmethod
    def new_count(n, amount): return min(max(n + math.floor(amount + 1e-9), 1), 1000)

    @staticmethod
    def spoke(group, instance):
        """The vector from the axis to the instance's centre."""
        r = sub(mean(instance), group["centre"])
        return sub(r, mul(dot(r, group["axis"]), group["axis"]))

    @staticmethod
    def positions(relation, group):
        n, start, end = len(group["instances"]), group["start"], group["end"]
        if n == 1:
            delta = mul(1 / (len(relation["parts"]) - 1), sub(relation["end"], relation["start"]))
            return [mul(0.5, add(start, end))], delta
        delta = mul(1 / (n - 1), sub(end, start))
        return [add(start, mul(i, delta)) for i in range(n)], delta

    @staticmethod
    def move_sides(relation, state, by_start, by_end):
        parent = state.parts[relation["parent"]]
        state.parts[relation["parent"]] = [
            add(c, by_start if sign(k, relation["axis"]) == -relation["direction"] else by_end)
            for k, c in enumerate(parent)]

    def delta_line(self, relation, state, amount, anchor):
        group = state.groups[relation["id"]]
        n = len(group["instances"])
        if n == 1:
            return
        _, delta = self.positions(relation, group)
        fixed = {"start": 0, "middle": (n - 1) / 2, "fit": (n - 1) / 2, "end": n - 1}[anchor]
        moves = [mul((i - fixed) * amount, delta) for i in range(n)]
        group["instances"] = [move(c, v) for c, v in zip(group["instances"], moves)]
        group["start"], group["end"] = add(group["start"], moves[0]), add(group["end"], moves[-1])
        self.move_sides(relation, state, moves[0], moves[-1])

    def count_line(self, relation, state, amount, anchor):
        group = state.groups[relation["id"]]
        n = len(group["instances"])
        new = self.new_count(n, amount)
        if new == n:
            return
        p, delta = self.positions(relation, group)
        middle = mul(0.5, add(group["start"], group["end"]))
        template = {"start": 0, "fit": 0, "middle": (n - 1) // 2, "end": n - 1}[anchor]
        if anchor == "start":
            targets = [add(p[0], mul(j, delta)) for j in range(new)]
        elif anchor == "end":
            targets = [sub(p[-1], mul(new - 1 - j, delta)) for j in range(new)]
        elif anchor == "middle":
            targets = [add(middle, mul(j - (new - 1) / 2, delta)) for j in range(new)]
        elif new == 1:
            targets = [middle]
        else:
            step = mul(1 / (new - 1), sub(group["end"], group["start"]))
            targets = [add(group["start"], mul(j, step)) for j in range(new)]
        copied = group["instances"][template]
        group["instances"] = [move(copied, sub(q, p[template])) for q in targets]
        if group["source"] < 0:
            group["source"] = template
        if anchor != "fit":
            self.move_sides(relation, state, sub(targets[0], group["start"]), sub(targets[-1], group["end"]))
            group["start"], group["end"] = targets[0], targets[-1]

    def delta_ring(self, relation, state, amount, _):
        group = state.groups[relation["id"]]
        parent = state.parts[relation["parent"]]
        group["instances"] = [move(c, mul(amount, self.spoke(group, c))) for c in group["instances"]]
        shift = [[0.0] * 3 for _ in range(8)]
        for axis in range(3):
            direction = axis_direction(parent, axis)
            if axis == relation["parent_axis"] or direction is None:
                continue
            for k in range(8):
                shift[k] = add(shift[k], mul(amount * group["radius"] * sign(k, axis), direction))
        state.parts[relation["parent"]] = [add(c, v) for c, v in zip(parent, shift)]
        group["radius"] *= 1 + amount

    def count_ring(self, relation, state, amount, _):
        group = state.groups[relation["id"]]
        n = len(group["instances"])
        new = self.new_count(n, amount)
        if new == n:
            return
        first, centre = group["instances"][0], group["centre"]
        group["instances"] = []
        for k in range(new):
            turn = rotation_matrix(group["axis"], 2 * math.pi * k / new)
            group["instances"].append([add(centre, matrix_times(turn, sub(c, centre))) for c in first])
        if group["source"] < 0:
            group["source"] = 0
