#!/usr/bin/env python3
"""Writes expression_vectors.json and program_vectors.json, which the tests of both languages read.

This is a third implementation of the edit language, in plain Python and written for reading. Expression values are
given as Python formulas, not computed by a parser of ours; program states come from the reference evaluator in
reference_evaluator.py and, wherever a case can be computed by hand, are checked here against a formula of its own.

Run it from anywhere: python3 tests/golden/make_vectors.py
"""
import json
import math
import os

import sys

sys.dont_write_bytecode = True

from expression_cases import CASES, ERRORS
from program_cases import build_cases, SHAPES

HERE = os.path.dirname(os.path.abspath(__file__))


def rounded(value):
    """Floats to 15 significant digits, so that the files stay readable; -0.0 becomes 0."""
    if isinstance(value, float):
        return float(f"{value:.15g}") + 0.0
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    return value


def lines(items):
    return ",\n".join(json.dumps(item, ensure_ascii=False) for item in items)


def write(name, text):
    with open(os.path.join(HERE, name), "w", encoding="utf-8") as file:
        file.write(text)


def main():
    cases = []
    for text, values, value in CASES:
        assert value is None or math.isfinite(value), text
        cases.append({"text": text, "values": values, "value": None if value is None else float(value)})
    errors = [{"text": text, "column": column} for text, column in ERRORS]
    write("expression_vectors.json", '{"cases":[\n%s\n],"errors":[\n%s\n]}\n' % (lines(cases), lines(errors)))

    programs = build_cases()
    shapes = ",\n".join(json.dumps(k) + ":" + json.dumps(rounded(v)) for k, v in SHAPES.items())
    write("program_vectors.json", '{"shapes":{\n%s\n},"cases":[\n%s\n]}\n' % (shapes, lines(rounded(programs))))
    print(f"{len(cases)} expressions, {len(errors)} refused expressions, {len(programs)} programs")


if __name__ == "__main__":
    main()
