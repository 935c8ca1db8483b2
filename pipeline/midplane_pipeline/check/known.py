"""Knowledge of a scene, as the options of its check say it, beside its results.

A VALUE is one of

  COLUMN            its last value              max:COLUMN, min:COLUMN    its largest, its smallest
  COLUMN@end:STEP   at the end of a step        COLUMN@max:OTHER          where another is largest, by the parabola
  COLUMN@OTHER=x    where another first passes x, linear between rows     through the rows there
  INTERFACE#STATUS  the length along which law points have that status in the last fields
"""

import argparse
import ast
import itertools
import math
import operator
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from midplane.stored import Stored

from midplane_pipeline.check.faults import Faults

Rows = list[dict[str, Any]]
Found = tuple[bool, Any]  # whether a name has this form, and its value

OPERATORS: dict[type, Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {"min": min, "max": max, "abs": abs, "sqrt": math.sqrt}


class Formula:
    """A formula of columns of a row: numbers, names, quoted if they are no words, + - * / **, brackets, min, max, abs, sqrt."""

    def __init__(self, text: str) -> None:
        self.text, self.tree = text, ast.parse(text, mode="eval").body
        self.value(self.tree, None)

    def __call__(self, row: dict[str, Any] | None) -> Any:
        """Its value in a row."""
        return self.value(self.tree, row)

    def value(self, node: ast.expr, row: dict[str, Any] | None) -> Any:
        """The value of a part; without a row only its form is looked at."""
        match node:
            case ast.Constant(value=int() | float() as number):
                return number
            case ast.Name(id=name) | ast.Constant(value=str(name)):
                return row[name] if row else 1.0
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
                values = self.value(left, row), self.value(right, row)
                result = OPERATORS[type(op)](*values) if row else 1.0
                if isinstance(result, complex):
                    raise ValueError(f"{ast.unparse(node)} is no real number")
                return result
            case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
                return OPERATORS[type(op)](self.value(operand, row))
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS and args:
                arguments = [self.value(arg, row) for arg in args]
                return FUNCTIONS[name](*arguments) if row else 1.0
        raise ValueError(f"{ast.unparse(node)} is no part of a formula")


@dataclass
class Expected:
    """VALUE=NUMBER~TOLERANCE or VALUE=LOW:HIGH"""

    name: str
    low: float
    high: float
    wanted: str

    @classmethod
    def parse(cls, text: str) -> Any:
        """One argument."""
        name, _, rest = text.rpartition("=")
        if ":" in rest:
            low, high = map(float, rest.split(":"))
            return cls(name, low, high, f"should be from {low:g} to {high:g}")
        value, tolerance = map(float, rest.split("~"))
        return cls(name, value - tolerance, value + tolerance, f"should be {value:.10g} within {tolerance:g}")

    def check(self, results: Path | str, rows: Rows, fields: dict[str, Any], faults: Faults) -> None:
        """The value lies inside."""
        found = value_of(self.name, rows, fields)
        if faults.expect(found is not None, f"{results}: no value {self.name}"):
            faults.expect(self.low <= found <= self.high, f"{results}: {self.name} is {found:.10g}, {self.wanted}")


@dataclass
class Like:
    """RUN:VALUE~TOLERANCE, relative; RUN is the name of another file of the scene"""

    run: str
    name: str
    tolerance: float

    @classmethod
    def parse(cls, text: str) -> Any:
        """One argument."""
        rest, _, tolerance = text.rpartition("~")
        run, _, name = rest.partition(":")
        return cls(run, name, float(tolerance))

    def check(self, results: Path | str, rows: Rows, others: Callable[[str], Rows], faults: Faults) -> None:
        """The value is that of the other run; `others` reads its rows."""
        pair = [value_of(self.name, run, {}) for run in (rows, others(self.run))]
        if faults.expect(None not in pair, f"{results}: no value {self.name} here or in {self.run}"):
            here, there = pair
            off = abs(here - there) / max(abs(here), abs(there), np.finfo(float).tiny)
            wanted = f"of {self.run}: {off:.1e} apart, more than {self.tolerance:g}"
            faults.expect(off <= self.tolerance, f"{results}: {self.name} is {here:.10g}, {there:.10g} {wanted}")


@dataclass
class Every:
    """COLUMN=FORMULA~TOLERANCE[@STEP], at every row, or at every row of a step"""

    column: str
    formula: Formula
    tolerance: float
    step: str

    @classmethod
    def parse(cls, text: str) -> Any:
        """One argument."""
        column, _, rest = text.partition("=")
        formula, _, rest = rest.rpartition("~")
        tolerance, _, step = rest.partition("@")
        return cls(column, Formula(formula), float(tolerance), step)

    def check(self, results: Path | str, rows: Rows, faults: Faults) -> None:
        """The column is what the formula of the other columns says."""
        rows = [row for row in rows if self.step in ("", row["step"])]
        if not faults.expect(rows, f"{results}: no rows of the step {self.step}"):
            return
        for number, row in enumerate(rows, 1):
            try:
                found, wanted = row[self.column], self.formula(row)
            except KeyError as name:
                faults.expect(False, f"{results}: no column {name}")
                return
            except (ArithmeticError, ValueError) as fault:
                wanted = f"{self.formula.text} has no value: {fault}"
                faults.expect(False, f"{results}: {wanted}, in row {number}")
                return
            if not faults.expect(
                abs(found - wanted) <= self.tolerance,
                f"{results}: {self.column} is {found:.10g} in row {number}{f' of {self.step}' if self.step else ''},"
                f" {self.formula.text} is {wanted:.10g}; apart by more than {self.tolerance:g}",
            ):
                return


def argument(form: type[Expected] | type[Like] | type[Every]) -> Callable[[str], Any]:
    """The type of an option that has this form."""

    def parse(text: str) -> Any:
        try:
            return form.parse(text)
        except (ValueError, SyntaxError, RecursionError) as fault:
            raise argparse.ArgumentTypeError(f"{text} is not {form.__doc__}: {fault}") from None

    return parse


def rows_of(path: Path) -> Rows:
    """The rows of a history.csv beyond the unloaded state, numbers as numbers."""
    rows = Stored(path.parent).history().to_dict("records")[1:]
    return [{str(name): value for name, value in row.items()} for row in rows]


def value_of(name: str, rows: Rows, fields: dict[str, Any]) -> Any:
    """The VALUE of that name; none if there is no such thing."""
    interface, _, status = name.rpartition("#")
    if interface in fields:
        field = fields[interface]
        return field["length"][field["status"] == int(status)].sum()
    for find in (extreme, at_the_end, at_a_peak, at_a_passing):
        found, value = find(name, rows)
        if found:
            return value
    return rows[-1].get(name) if rows else None


def extreme(name: str, rows: Rows) -> Found:
    """max:COLUMN, min:COLUMN"""
    kind, _, column = name.partition(":")
    here = kind in ("max", "min") and bool(rows) and column in rows[0]
    return here, {"max": max, "min": min}[kind](row[column] for row in rows) if here else None


def at_the_end(name: str, rows: Rows) -> Found:
    """COLUMN@end:STEP"""
    column, at, step = name.partition("@end:")
    last = [row[column] for row in rows if row["step"] == step and column in row]
    return bool(at), last[-1] if last else None


def at_a_peak(name: str, rows: Rows) -> Found:
    """COLUMN@max:OTHER"""
    column, at, largest = name.partition("@max:")
    if not at or not rows or not {column, largest} <= rows[0].keys():
        return bool(at), None
    peak = max(range(len(rows)), key=lambda row: rows[row][largest])
    if 0 < peak < len(rows) - 1:
        near = [[rows[row][key] for row in (peak - 1, peak, peak + 1)] for key in (column, largest)]
        roots: Any = np.polynomial.Polynomial.fit(near[0], near[1], 2).deriv().roots() if len(set(near[0])) == 3 else []
        inside = [root for root in roots if min(near[0]) <= root <= max(near[0])]
        if inside:
            return True, inside[0]
    return True, rows[peak][column]


def at_a_passing(name: str, rows: Rows) -> Found:
    """COLUMN@OTHER=x"""
    column, at, condition = name.partition("@")
    other, equals, value = condition.rpartition("=")
    if not at or not equals or not rows or not {column, other} <= rows[0].keys():
        return False, None
    x = float(value)
    for before, row in itertools.pairwise(rows):
        low, high = before[other], row[other]
        if low != high and min(low, high) <= x <= max(low, high):
            return True, before[column] + (row[column] - before[column]) * (x - low) / (high - low)
    return True, None
