"""Shapes, programs and samples for program_vectors.json, with hand formulas for the cases that have one."""
import itertools
import math

from reference_evaluator import Reference, add, dot, mul, norm, rotation_matrix, matrix_times, sign, sub

IDENTITY = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
WHOLE, FACE, EDGE, CORNER = [0, 0, 0], [0, 1, 0], [-1, 0, 1], [1, -1, 1]


def box(centre, half, axes=IDENTITY):
    corners = []
    for k in range(8):
        corner = list(centre)
        for axis in range(3):
            corner = add(corner, mul(sign(k, axis) * half[axis], axes[axis]))
        corners.append(corner)
    return corners


def part(name, node, corners, axes=IDENTITY, members=()):
    return {"id": name, "label": name.split("_")[0], "name": name.replace("_", " "), "node": node,
            "primitive": -1 if members else 0, "corners": corners, "axes": axes, "virtual": bool(members),
            "members": list(members)}


def shape(name, parts, relations):
    return {"format": "parsel/shape", "version": 1, "name": name, "sha256": "0" * 64,
            "frame": {"centre": [0, 0, 0], "scale": 1}, "parts": parts, "relations": relations, "warnings": []}


def turned_axes(axis, angle):
    matrix = rotation_matrix(axis, angle)
    return [matrix_times(matrix, a) for a in IDENTITY]


def attachment(name, a, b, point, local_a, local_b):
    return {"id": name, "kind": "point", "parts": [a, b], "points": [point], "local_a": [local_a], "local_b": [local_b]}


# A seat along the global axes and a leg that leans: their common point is the seat's bottom and the leg's top corner.
LEAN = turned_axes([0, 0, 1], math.pi / 6)
SEAT_CENTRE, SEAT_HALF, LEG_HALF = [0.1, 0.2, -0.05], [0.5, 0.1, 0.4], [0.05, 0.3, 0.06]
ANCHOR = [0.4, 0.1, 0.15]
LEG_CENTRE = sub(ANCHOR, mul(LEG_HALF[1], LEAN[1]))
PAIR = shape("pair", [
    part("seat", 2, box(SEAT_CENTRE, SEAT_HALF)),
    part("leg", 5, box(LEG_CENTRE, LEG_HALF, LEAN), LEAN),
], [attachment("a1", "seat", "leg", ANCHOR, [(ANCHOR[i] - SEAT_CENTRE[i]) / SEAT_HALF[i] for i in range(3)], [0, 1, 0])])

# Five slats that run from +x to -x (direction -1), between two rails.
SLAT_X = [0.4, 0.2, 0, -0.2, -0.4]
SLAT_HALF = [0.04, 0.3, 0.02]
SLAT_IDS = [f"slat_{i + 1}" for i in range(5)]
SLATS = shape("slats", [
    part("rail_top", 0, box([0, 0.35, 0], [0.5, 0.05, 0.05])),
    *[part(SLAT_IDS[i], i + 1, box([x, 0, 0], SLAT_HALF)) for i, x in enumerate(SLAT_X)],
    part("slats", -1, box([0, 0, 0], [0.44, 0.3, 0.02]), members=SLAT_IDS),
], [
    {"id": "t1", "kind": "translation", "parts": SLAT_IDS, "parent": "slats", "start": [0.4, 0, 0], "end": [-0.4, 0, 0],
     "axis": 0, "direction": -1},
    attachment("a1", "rail_top", "slats", [0, 0.3, 0], [0, -1, 0], [0, 1, 0]),
])

# Six legs around the vertical through (0.1, ·, 0.2); leg 0 is toward +x.
RING_CENTRE, RING_RADIUS, RING_LEG = [0.1, -0.3, 0.2], 0.5, [0.05, 0.3, 0.03]
RING_IDS = [f"leg_{i + 1}" for i in range(6)]


def ring_axes(k, n): return turned_axes([0, 1, 0], 2 * math.pi * k / n)


def ring_leg(k, n, radius=RING_RADIUS):
    axes = ring_axes(k, n)
    return box(add(RING_CENTRE, mul(radius, axes[0])), RING_LEG, axes)


RING_HALF = [0.6, 0.3, 0.6]
RING = shape("ring", [
    part("top", 0, box([0.1, 0.05, 0.2], [0.7, 0.05, 0.7])),
    *[part(RING_IDS[k], k + 1, ring_leg(k, 6), ring_axes(k, 6)) for k in range(6)],
    part("legs", -1, box(RING_CENTRE, RING_HALF), members=RING_IDS),
], [
    {"id": "o1", "kind": "rotation", "parts": RING_IDS, "parent": "legs", "centre": RING_CENTRE, "axis": [0, 1, 0],
     "parent_axis": 1, "radius": RING_RADIUS},
    attachment("a1", "top", "legs", [0.1, 0, 0.2], [0, -1, 0], [0, 1, 0]),
])

SHAPES = {"pair": PAIR, "slats": SLATS, "ring": RING}


def layer(name, statements, low=-0.5, high=0.5, request=""):
    return {"request": request, "parameter": {"name": name, "min": low, "max": high, "value": 0},
            "statements": statements, "relations": []}


def program(shape_name, *layers):
    return {"format": "parsel/program", "version": 1, "shape": {"name": shape_name, "sha256": "0" * 64},
            "layers": list(layers)}


def is_close(a, b): return all(abs(x - y) < 1e-12 for p, q in zip(a, b) for x, y in zip(p, q)) and len(a) == len(b)


class Cases:
    def __init__(self):
        self.cases = []

    def add(self, name, shape_name, layers, samples, hand=None):
        """`hand` maps values to {part id or (group id, instance): corners} that must come out."""
        reference = Reference(SHAPES[shape_name])
        text = program(shape_name, *layers)
        entry = {"name": name, "shape": shape_name, "program": text, "samples": []}
        for values in samples:
            state = reference.evaluate(text, values)
            sample = {"values": values,
                      "parts": {k: v for k, v in state.parts.items() if v != reference.rest.parts[k]},
                      "groups": {k: v for k, v in state.groups.items() if v != reference.rest.groups[k]}}
            if hand is not None:
                for key, corners in hand(*values).items():
                    got = state.groups[key[0]]["instances"][key[1]] if isinstance(key, tuple) else state.parts[key]
                    assert is_close(got, corners), (name, values, key, got, corners)
            entry["samples"].append(sample)
        self.cases.append(entry)


def geometric(cases):
    """Every geometric operator on every kind of feature, with literal and with part references, by hand formulas."""
    features = {"whole": WHOLE, "face": FACE, "edge": EDGE, "corner": CORNER}
    seat, leg = box(SEAT_CENTRE, SEAT_HALF), box(LEG_CENTRE, LEG_HALF, LEAN)
    origins = {"literal": ([0.2, -0.1, 0.3], [0.2, -0.1, 0.3]),
               "own": ({"part": "seat", "at": [-1, 0, 0]}, [-0.4, 0.2, -0.05]),
               "other": ({"part": "leg", "at": [0, 1, 0]}, ANCHOR),
               "corner": ({"part": "seat", "at": [1, 1, -1]}, [0.6, 0.3, -0.45])}
    third = 1 / 3
    directions = {"literal": ([2, -1, 2], [2 * third, -third, 2 * third]), "own": ({"part": "seat", "axis": 2}, [0, 0, 1]),
                  "other": ({"part": "node:5", "axis": 0}, LEAN[0]), "unit": ([0, -1, 0], [0, -1, 0])}

    def case(op, feature, fields, formula, tag):
        statement = {"op": op, "part": "seat", "feature": features[feature], **fields, "amount": "2*x1"}

        def hand(x):
            return {"seat": [formula(c, 2 * x) if all(f in (0, sign(k, i)) for i, f in enumerate(features[feature])) else c
                             for k, c in enumerate(seat)], "leg": leg}
        cases.add(f"{op} {feature} {tag}", "pair", [layer("x1", [statement])], [[0], [0.15], [-0.4]], hand)

    def turn(o, n, c, a):
        """Rotation by splitting along and across the axis."""
        r = sub(c, o)
        along = mul(dot(r, n), n)
        across = sub(r, along)
        side = [n[1] * r[2] - n[2] * r[1], n[2] * r[0] - n[0] * r[2], n[0] * r[1] - n[1] * r[0]]
        return add(o, add(along, add(mul(math.cos(a), across), mul(math.sin(a), side))))

    kinds = list(zip(itertools.cycle(features), itertools.product(origins, directions)))
    for i, (feature, (o_key, d_key)) in enumerate(kinds):
        o_field, o = origins[o_key]
        d_field, d = directions[d_key]
        n_field, n = directions[list(directions)[(i // 4 + i + 1) % 4]]
        tag = f"origin {o_key}, direction {d_key}"
        if o_key == "literal":
            for f in features:
                case("translate", f, {"direction": d_field}, lambda c, a, d=d: add(c, mul(a, d)), f"direction {d_key}")
        if d_key == "unit":
            case("scale_3d", feature, {"origin": o_field}, lambda c, a, o=o: add(o, mul(1 + a, sub(c, o))), f"origin {o_key}")
        # The feature must not be tied to the direction: both have period 4.
        turned = list(features)[(i + i // 4) % 4]
        case("rotate", turned, {"origin": o_field, "axis": d_field}, lambda c, a, o=o, d=d: turn(o, d, c, a), tag)
        case("scale_1d", turned, {"origin": o_field, "direction": d_field},
             lambda c, a, o=o, d=d: add(c, mul(a * dot(d, sub(c, o)), d)), tag)
        case("scale_2d", turned, {"origin": o_field, "normal": d_field},
             lambda c, a, o=o, d=d: add(mul(1 + a, c), add(mul(-a, o), mul(-a * dot(d, sub(c, o)), d))), tag)
        case("shear", turned, {"origin": o_field, "normal": n_field, "direction": d_field},
             lambda c, a, o=o, d=d, n=n: add(c, mul(a * dot(n, sub(c, o)), d)), tag)


def layers(cases):
    """Layers run in order and read their references at their own start."""
    shift = {"op": "translate", "part": "seat", "direction": [1, 0, 0], "amount": "x1"}
    turn = {"op": "rotate", "part": "seat", "origin": [0, 0, 0], "axis": [0, 0, 1], "amount": "x1"}
    grow = {"op": "scale_1d", "part": "seat", "origin": {"part": "seat", "at": [0, 0, 0]},
            "direction": {"part": "seat", "axis": 0}, "amount": "x2"}
    follow = {"op": "translate", "part": "leg", "direction": {"part": "seat", "axis": 1}, "amount": "x2"}
    seat, leg = box(SEAT_CENTRE, SEAT_HALF), box(LEG_CENTRE, LEG_HALF, LEAN)

    def moved_then_grown(x, y):
        return {"seat": box(add(SEAT_CENTRE, [x, 0, 0]), [0.5 * (1 + y), 0.1, 0.4])}

    def turned_then_grown(x, y):
        axes = turned_axes([0, 0, 1], x)
        centre = matrix_times(rotation_matrix([0, 0, 1], x), SEAT_CENTRE)
        return {"seat": box(centre, [0.5 * (1 + y), 0.1, 0.4], axes), "leg": [add(c, mul(y, axes[1])) for c in leg]}

    cases.add("layers: scale about the centre of a moved part", "pair", [layer("x1", [shift]), layer("x2", [grow])],
              [[0, 0], [0.2, 0], [0.2, 0.3], [-0.1, -0.4]], moved_then_grown)
    cases.add("layers: axis of a turned part", "pair", [layer("x1", [turn]), layer("x2", [grow, follow])],
              [[0, 0], [0.3, 0.1], [-0.45, 0.4]], turned_then_grown)
    cases.add("statements of one layer run in order but read references at its start", "pair",
              [layer("x1", [shift, {**grow, "amount": "x1"}])], [[0], [0.25], [-0.3]],
              lambda x: {"seat": [[c[0] + x + x * (c[0] + x - 0.1), c[1], c[2]] for c in seat]})
    cases.add("amounts of two parameters", "pair",
              [layer("x1", [shift]), layer("x2", [{**shift, "part": "leg", "amount": "x1*x2+max(x1,x2)"}])],
              [[0, 0], [0.3, -0.2], [-0.4, 0.5]], lambda x, y: {"leg": [add(c, [x * y + max(x, y), 0, 0]) for c in leg]})
    cases.add("keep_fixed", "pair", [layer("x1", [{"op": "keep_fixed", "part": "seat"}])], [[0], [0.5]],
              lambda x: {"seat": seat, "leg": leg})
    cases.add("a part by its node", "pair", [layer("x1", [{**shift, "part": "node:2"}])], [[0.1]],
              lambda x: {"seat": [add(c, [x, 0, 0]) for c in seat]})
    everything = layer("x1", [
        {**shift, "why": {"kind": "seed", "relations": []}},
        {"op": "keep_fixed", "part": "leg", "why": {"kind": "attachment", "relations": ["a1"]}}],
        request="move the \"seat\" → right\n# not a comment, \\ no escape")
    everything["relations"] = [{"id": "a1", "status": "broken", "worst": 0.5, "proof": "certified"}]
    cases.add("why, reports and an awkward request", "pair", [everything], [[0], [0.5]])
    cases.add("no layers", "pair", [], [[]], lambda: {"seat": seat, "leg": leg})
    cases.add("no statements", "pair", [layer("x1", [])], [[0.5]], lambda x: {"seat": seat})
    cases.add("tapered, then sheared, then turned corner", "pair", [
        layer("x1", [{"op": "scale_1d", "part": "seat", "feature": [0, -1, 0], "origin": {"part": "seat", "at": [0, -1, 0]},
                      "direction": {"part": "seat", "axis": 0}, "amount": "-x1"}]),
        layer("x2", [{"op": "shear", "part": "seat", "origin": {"part": "seat", "at": [0, 1, 0]},
                      "normal": {"part": "seat", "axis": 1}, "direction": {"part": "leg", "axis": 2}, "amount": "sin(x2)"},
                     {"op": "rotate", "part": "seat", "feature": CORNER, "origin": {"part": "seat", "at": [1, 0, 0]},
                      "axis": {"part": "seat", "axis": 0}, "amount": "pi*x2/2"}])],
        [[0, 0], [0.4, 0.3], [-0.2, -0.5]])


def statement(op, amount="x1", **fields): return {"op": op, **fields, "amount": amount}


def count(amount, anchor="middle", group="t1"): return statement("change_count", amount, relation=group, anchor=anchor)


def delta(amount, anchor="middle", group="t1"): return statement("change_delta", amount, relation=group, anchor=anchor)


def lines_of_slats(cases):
    def slats(xs, half=SLAT_HALF): return {("t1", i): box([x, 0, 0], half) for i, x in enumerate(xs)}
    def parent(low, high): return {"slats": box([(low + high) / 2, 0, 0], [(high - low) / 2, 0.3, 0.02])}

    # Instances run toward -x with delta -0.2; the parent reaches 0.04 beyond the outer centres.
    for anchor in ("start", "middle", "end", "fit"):
        def by_count(x, anchor=anchor):
            n = max(1, 5 + math.floor(10 * x + 1e-9))
            first = {"start": 0.4, "end": -0.4 + 0.2 * (n - 1), "middle": 0.1 * (n - 1), "fit": 0.4 if n > 1 else 0}[anchor]
            step = -0.8 / max(1, n - 1) if anchor == "fit" else -0.2
            xs = [first + step * i for i in range(n)]
            side = (0.4, -0.4) if anchor == "fit" else (xs[0], xs[-1])
            return {**slats(xs), **parent(side[1] - 0.04, side[0] + 0.04), "slat_5": box([xs[min(4, n - 1)], 0, 0], SLAT_HALF)}
        cases.add(f"change_count {anchor}", "slats", [layer("x1", [count("10*x1", anchor)], -1, 1)],
                  [[0], [0.2], [0.35], [-0.2], [-0.05], [-0.9]], by_count)

        def by_delta(x, anchor=anchor):
            fixed = {"start": 0.4, "middle": 0, "fit": 0, "end": -0.4}[anchor]
            xs = [fixed + (p - fixed) * (1 + x) for p in SLAT_X]
            return {**slats(xs), **parent(xs[-1] - 0.04, xs[0] + 0.04), "slat_2": box([xs[1], 0, 0], SLAT_HALF)}
        cases.add(f"change_delta {anchor}", "slats", [layer("x1", [delta("x1", anchor)])], [[0], [0.5], [-0.25]], by_delta)

    widen = statement("scale_1d", "x1", part="slats", origin={"part": "slats", "at": [0, 0, 0]}, direction={"part": "slats", "axis": 0})
    cases.add("top-down: the parent widened", "slats", [layer("x1", [widen])], [[0], [0.5], [-0.4]],
              lambda x: {**slats([p * (1 + x) for p in SLAT_X], [0.04 * (1 + x), 0.3, 0.02]), **parent(-0.44 * (1 + x), 0.44 * (1 + x))})
    cases.add("top-down: widened, then refilled", "slats",
              [layer("x1", [widen, count("floor(5*x1)", "fit")])], [[0], [0.2], [0.45], [-0.4]],
              lambda x: slats([0.4 * (1 + x) * (1 - 2 * i / (4 + math.floor(5 * x + 1e-9))) for i in range(5 + math.floor(5 * x + 1e-9))],
                              [0.04 * (1 + x), 0.3, 0.02]))
    taper = statement("scale_1d", "x1", part="slats", feature=[0, 1, 0], origin={"part": "slats", "at": [0, 1, 0]}, direction=[1, 0, 0])

    def fan(x):
        return {("t1", i): [[c[0] * (1 + x) if c[1] > 0 else c[0], c[1], c[2]] for c in box([p, 0, 0], SLAT_HALF)]
                for i, p in enumerate(SLAT_X)}
    cases.add("top-down: the parent's upper face widened", "slats", [layer("x1", [taper])], [[0], [0.5], [-0.5]], fan)
    cases.add("top-down: tapered twice, up and down", "slats",
              [layer("x1", [taper]), layer("x2", [statement("scale_1d", "x2", part="slats", feature=[0, -1, 0],
                                                           origin={"part": "slats", "at": [0, -1, 0]}, direction=[1, 0, 0])])],
              [[0, 0], [0.5, 0], [0.5, -0.4], [-0.3, 0.2]],
              lambda x, y: {("t1", i): [[c[0] * (1 + (x if c[1] > 0 else y)), c[1], c[2]] for c in box([p, 0, 0], SLAT_HALF)]
                            for i, p in enumerate(SLAT_X)})
    cases.add("top-down: an edge, then a corner, of a parent that is no box any more", "slats",
              [layer("x1", [statement("translate", "x1", part="slats", feature=[1, 1, 0], direction=[0, 1, 0])]),
               layer("x2", [statement("translate", "x2", part="slats", feature=[-1, -1, 1], direction=[0.6, 0, 0.8]),
                            statement("scale_3d", "x2/2", part="slats", feature=[0, 0, -1], origin={"part": "slats", "at": [0, 0, 0]})])],
              [[0, 0], [0.2, 0.1], [-0.15, 0.3]])
    cases.add("the parent turned: groups follow", "slats",
              [layer("x1", [statement("rotate", "pi*x1", part="slats", origin={"part": "slats", "at": [-1, 0, 0]}, axis=[0, 0, 1])]),
               layer("x2", [delta("x2", "start"), count("4*x2", "end")])],
              [[0, 0], [0.5, 0.25], [-0.25, -0.5]])
    shift = statement("translate", "x1", part="slat_2", direction=[0, 0, 1])
    cases.add("a member alone", "slats", [layer("x1", [shift])], [[0], [0.1]],
              lambda x: {"slat_2": [add(c, [0, 0, x]) for c in box([0.2, 0, 0], SLAT_HALF)], ("t1", 2): box([0, 0, 0], SLAT_HALF),
                         **parent(-0.44, 0.44)})
    cases.add("a member by a feature about its own face, then the group spread", "slats",
              [layer("x1", [statement("scale_2d", "x1", part="slat_1", feature=[0, -1, 0], origin={"part": "slat_1", "at": [0, -1, 0]},
                                      normal={"part": "slat_1", "axis": 1}), delta("x1", "end")])], [[0], [0.3]])
    cases.add("the first member edited, then copied", "slats", [layer("x1", [{**shift, "part": "slat_1"}, count("20*x1", "start")])],
              [[0], [0.1], [-0.1]],
              lambda x: {("t1", i): box([0.4 - 0.2 * i, 0, x], SLAT_HALF) for i in range(5 + math.floor(20 * x + 1e-9))})
    cases.add("counts stacked: down to one, then up again at the spacing of the rest", "slats",
              [layer("x1", [count("10*x1", "middle")], -1, 1), layer("x2", [count("10*x2", "start")], -1, 1)],
              [[0, 0], [-0.4, 0.2], [-0.4, 0], [0.1, -0.2], [0, -0.1]])
    cases.add("fit to one, then fit to three, then spread", "slats",
              [layer("x1", [count("10*x1", "fit")], -1, 1), layer("x2", [count("10*x2", "fit"), delta("x2", "middle")], -1, 1)],
              [[-0.4, 0], [-0.4, 0.2], [-0.1, 0.1]])
    cases.add("fit to one, then a start count", "slats",
              [layer("x1", [count("10*x1", "fit")], -1, 1), layer("x2", [count("10*x2", "start"), delta("x2", "start")], -1, 1)],
              [[-0.4, 0.2], [-0.4, 0]])
    cases.add("spread to the middle, count from the end", "slats",
              [layer("x1", [delta("x1", "middle"), count("8*x1", "end")])], [[0], [0.3], [-0.3]])
    cases.add("a later layer refers to members of a changed group", "slats",
              [layer("x1", [count("10*x1", "start")], -1, 1),
               layer("x2", [statement("translate", "x2", part="rail_top", direction=[0, 1, 0]),
                            statement("scale_1d", "x2", part="rail_top", origin={"part": "slat_5", "at": [-1, 0, 0]}, direction={"part": "slats", "axis": 0})])],
              [[0, 0.1], [-0.3, 0.2], [0.2, 0.3]])
    cases.add("the count never goes below one", "slats", [layer("x1", [count("-1000*abs(x1)", "end")])], [[0.5]],
              lambda x: {("t1", 0): box([-0.4, 0, 0], SLAT_HALF)})
    cases.add("rounding noise does not lose an instance", "slats", [layer("x1", [count("3*(x1+0.2)-0.6-1e-12+x1-x1", "start")])], [[0]],
              lambda x: {("t1", 4): box([-0.4, 0, 0], SLAT_HALF)})


def rings_of_legs(cases):
    def ring(n, radius=RING_RADIUS): return {("o1", k): ring_leg(k, n, radius) for k in range(n)}
    cases.add("ring: change_count", "ring", [layer("x1", [count("10*x1", group="o1")], -1, 1)], [[0], [0.2], [-0.3], [-0.9]],
              lambda x: {**ring(max(1, 6 + math.floor(10 * x + 1e-9))), "legs": box(RING_CENTRE, RING_HALF)})
    cases.add("ring: change_delta", "ring", [layer("x1", [delta("x1", group="o1")])], [[0], [0.4], [-0.3]],
              lambda x: {**ring(6, RING_RADIUS * (1 + x)), "legs": box(RING_CENTRE, [0.6 + 0.5 * x, 0.3, 0.6 + 0.5 * x])})
    cases.add("ring: moved, then widened, then counted", "ring",
              [layer("x1", [statement("translate", "x1", part="legs", direction=[0, 1, 0])]),
               layer("x2", [delta("x2", group="o1"), count("10*x2", group="o1")])], [[0, 0], [0.2, 0.2], [-0.1, -0.3]],
              lambda x, y: {("o1", k): [add(c, [0, x, 0]) for c in ring_leg(k, 6 + math.floor(10 * y + 1e-9), 0.5 * (1 + y))]
                            for k in range(6 + math.floor(10 * y + 1e-9))})
    grow = statement("scale_2d", "x1", part="legs", origin={"part": "legs", "at": [0, 0, 0]}, normal={"part": "legs", "axis": 1})

    def grown(x):
        def scale(c): return [0.1 + (c[0] - 0.1) * (1 + x), c[1], 0.2 + (c[2] - 0.2) * (1 + x)]
        return {("o1", k): [scale(c) for c in ring_leg(k, 6)] for k in range(6)}
    cases.add("ring: the parent scaled across the axis", "ring", [layer("x1", [grow])], [[0], [0.3], [-0.3]], grown)
    cases.add("ring: scaled, then spread by the new radius", "ring", [layer("x1", [grow, delta("x1", group="o1")])], [[0], [0.3], [-0.3]])
    tilt = statement("rotate", "x1", part="legs", origin=[0, 0, 0], axis=[0, 0, 1])
    cases.add("ring: tilted, the axis follows", "ring", [layer("x1", [tilt]), layer("x2", [delta("x2", group="o1"), count("8*x2", group="o1")])],
              [[0, 0], [0.3, 0.25], [-0.4, -0.25]])
    cases.add("ring: the lower face scaled, legs spread at the foot, then more legs", "ring",
              [layer("x1", [statement("scale_2d", "x1", part="legs", feature=[0, -1, 0], origin={"part": "legs", "at": [0, -1, 0]},
                                      normal={"part": "legs", "axis": 1})]),
               layer("x2", [count("8*x2", group="o1"), delta("x2", group="o1")])], [[0, 0], [0.3, 0.25], [-0.3, -0.4]])
    cases.add("ring: stretched along x it is no circle, the radius is the mean", "ring",
              [layer("x1", [statement("scale_1d", "x1", part="legs", origin={"part": "legs", "at": [0, 0, 0]}, direction=[1, 0, 0])]),
               layer("x2", [delta("x2", group="o1")])], [[0, 0], [0.4, 0.3]])
    cases.add("ring: an edge of the parent moved, then its face", "ring",
              [layer("x1", [statement("translate", "x1", part="legs", feature=[1, -1, 0], direction=[0, -1, 0])]),
               layer("x2", [statement("rotate", "x2", part="legs", feature=[0, 1, 0], origin={"part": "legs", "at": [0, 1, 0]}, axis={"part": "legs", "axis": 1})])],
              [[0, 0], [0.2, 0.3], [-0.1, -0.2]])
    member = statement("translate", "x1", part="leg_1", direction={"part": "leg_1", "axis": 0})
    cases.add("ring: one leg out, then all turned copies of it", "ring", [layer("x1", [member, count("10*x1", group="o1")])],
              [[0], [0.1], [-0.1]], lambda x: ring(6 + math.floor(10 * x + 1e-9), 0.5 + x) if x else ring(6))
    cases.add("ring: another leg alone", "ring", [layer("x1", [{**member, "part": "leg_3", "direction": {"part": "leg_3", "axis": 0}}])],
              [[0.1]], lambda x: {"leg_3": ring_leg(2, 6, 0.5 + x), "leg_2": ring_leg(1, 6)})


def build_cases():
    cases = Cases()
    geometric(cases)
    layers(cases)
    lines_of_slats(cases)
    rings_of_legs(cases)
    names = [case["name"] for case in cases.cases]
    assert len(set(names)) == len(names)
    return cases.cases
