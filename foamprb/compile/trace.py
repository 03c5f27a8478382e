"""Stages as straight-line code: the text of a loop over lanes, executed once with symbols for its numbers.

The formulas branch on no value, so that one pass through them meets every operation there is. Of these,
equal ones are written down once, as LLVM's operations on registers full of lanes: neither the types of some
thousand expressions have to be found out, nor loops to be recognised as those over lanes.

A stage is traced if it is nothing but loops ``for i in range(LANES)``, by this name, over a block: rows of so
many numbers, addressed as ``block[row * LANES + i]``.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Hashable, Iterator, Sequence
from functools import partial
from types import CellType, FunctionType, SimpleNamespace
from typing import Any

import numpy as np

__all__ = ["LANES", "REGISTERS", "Code", "UntraceableError", "branch", "trace"]

LANES = "LANES"
"""Global name of the number of lanes in stages."""
REGISTERS = "_registers"
"""Attribute of stages to be traced: the number of registers of lanes that go through them together."""


class UntraceableError(Exception):
    """Another text than that of a stage."""


def branch(condition: Any, a: Any, b: Any) -> Any:
    """What :func:`foamprb.body.tensor.select` is of numbers: the one branch that can be traced."""
    return a if condition else b


class Code:
    """The operations of a stage, in LLVM's language.

    Parameters
    ----------
    lanes
        Lanes of a block.
    together
        How many of them go through an operation together; the number of lanes is a multiple of it.
    flags
        LLVM's flags of operations on floats.
    passes
        How often a loop over lanes is gone through, each time as by another lane.
    """

    def __init__(self, lanes: int, together: int, flags: str, passes: int = 1) -> None:
        self.lanes, self._together, self._flags, self._passes = lanes, together, flags, passes
        self._numbers, self._conditions = f"<{together} x double>", f"<{together} x i1>"
        self._bits = f"<{together} x i64>"
        self._lines: list[str] = []
        self._known: dict[str, str] = {}
        self._magnitudes: set[str] = set()
        self._loops = self._loop = 0
        self._functions: dict[str, int] = {}
        self._origins: list[Any] = []
        self.block = _Block(self)
        """Stands for the block."""

    def argument(self, origin: Any) -> Symbol:
        """Stand for a number that is the same in all lanes; ``origin`` tells the caller where it is from."""
        self._origins.append(origin)
        return Symbol(self, f"%all{len(self._origins) - 1}", None)

    @property
    def arguments(self) -> tuple[Any, ...]:
        """The origins of the arguments that come after the block."""
        return tuple(self._origins)

    def function(self, name: str) -> str:
        """LLVM's text of a function of the block and the arguments: all operations, in all lanes."""
        each = range(len(self._origins))
        parameters = ", ".join(["ptr %block", *(f"double %one{k}" for k in each)])
        spread = "".join(
            f"%first{k} = insertelement {self._numbers} poison, double %one{k}, i64 0\n"
            f"%all{k} = shufflevector {self._numbers} %first{k}, {self._numbers} poison, "
            f"<{self._together} x i32> zeroinitializer\n"
            for k in each
        )
        declared = "".join(
            f"declare {self._numbers} {called}({', '.join(n * [self._numbers])})\n"
            for called, n in self._functions.items()
        )
        operations = "\n".join(filter(None, self._lines))
        return (
            f"{declared}"
            f'define linkonce_odr void @"{name}"({parameters}) alwaysinline {{\n'
            "entry:\n"
            f"{spread}"
            "br label %some\n"
            "some:\n"
            "%lane = phi i64 [0, %entry], [%next, %some]\n"
            "%here = getelementptr double, ptr %block, i64 %lane\n"
            f"{operations}\n"
            f"%next = add nuw nsw i64 %lane, {self._together}\n"
            f"%more = icmp ult i64 %next, {self.lanes}\n"
            "br i1 %more, label %some, label %done\n"
            "done:\n"
            "ret void\n"
            "}\n"
        )

    def each_lane(self) -> Iterator[_Place]:
        """Go through all lanes at once."""
        before = self.block.known
        for _ in range(self._passes):
            self.block.known = dict(before)
            self._loops += 1
            self._loop = self._loops
            yield _Place(0)
        self._loop = 0

    def does_as(self, other: Code) -> bool:
        """Whether another code has the same operations, and leaves the same in the block."""
        mine, its = ({k: _text(v) for k, v in code.block.known.items()} for code in (self, other))
        return self._known == other._known and mine == its

    def load(self, offset: int) -> Symbol:
        """The numbers that were so far from the block's beginning before anything was stored there."""
        text = f"load {self._numbers}, ptr {self._address(offset)}, align 8"
        return Symbol(self, self._once(text), self.loop)

    def store(self, offset: int, value: Any) -> int:
        """Put numbers there; the line that does it."""
        operand = self._operand(value)
        self._lines.append(f"store {self._numbers} {operand}, ptr {self._address(offset)}, align 8")
        return len(self._lines) - 1

    def leave_out(self, line: int) -> None:
        """Do not do what a line does."""
        self._lines[line] = ""

    @property
    def loop(self) -> int:
        """The number of the loop over lanes that is gone through.

        Raises
        ------
        UntraceableError
            If there is none: a lane's number is wanted after all lanes.
        """
        if self._loop == 0:
            raise UntraceableError("a number of one lane after all")
        return self._loop

    def unary(self, operation: str, a: Any) -> Symbol:
        """An operation on numbers."""
        return Symbol(*self._result(f"{operation} {self._flags} {self._numbers} {self._operand(a)}", a))

    def binary(self, operation: str, a: Any, b: Any) -> Symbol:
        """An operation on two numbers."""
        start = f"{operation} {self._flags} {self._numbers}"
        text, turned = f"{start} {self._operand(a)}, {self._operand(b)}", ""
        if operation in ("fadd", "fmul"):
            turned = f"{start} {self._operand(b)}, {self._operand(a)}"
        return Symbol(*self._result(turned if turned in self._known else text, a, b))

    def call(self, function: str, *operands: Any) -> Symbol:
        """A function that LLVM has."""
        name = f"@llvm.{function}.v{self._together}f64"
        self._functions[name] = len(operands)
        given = ", ".join(f"{self._numbers} {self._operand(a)}" for a in operands)
        return Symbol(*self._result(f"call {self._flags} {self._numbers} {name}({given})", *operands))

    def magnitude(self, a: Any) -> Symbol:
        """Of a number, without its sign."""
        result = self.call("fabs", a)
        self._magnitudes.add(result.name)
        return result

    def maximum(self, a: Any, b: Any) -> Any:
        """The larger of two numbers; no number if one of them is none, as numpy has it.

        Magnitudes are ordered as the whole numbers that have their bits are, those of no number above all
        others, which takes one instruction instead of three.
        """
        if not (self._is_magnitude(a) and self._is_magnitude(b)):
            return self.call("maximum", a, b)
        if _is(0.0, a):
            return b
        if _is(0.0, b):
            return a
        p, q = (f"bitcast {self._numbers} {self._operand(value)} to {self._bits}" for value in (a, b))
        p, q = self._once(p), self._once(q)
        larger = self._once(f"icmp sgt {self._bits} {p}, {q}")
        chosen = self._once(f"select {self._conditions} {larger}, {self._bits} {p}, {self._bits} {q}")
        result = Symbol(*self._result(f"bitcast {self._bits} {chosen} to {self._numbers}", a, b))
        self._magnitudes.add(result.name)
        return result

    def _is_magnitude(self, value: Any) -> bool:
        if isinstance(value, Symbol):
            return value.name in self._magnitudes
        return bool(value >= 0.0)

    def compare(self, relation: str, a: Any, b: Any) -> Condition:
        """Whether a relation holds."""
        operands = f"{self._numbers} {self._operand(a)}, {self._operand(b)}"
        return Condition(*self._result(f"fcmp {self._flags} {relation} {operands}", a, b))

    def combine(self, operation: str, a: Any, b: Any) -> Condition:
        """Whether both conditions hold, or one of them."""
        operands = f"{self._conditions} {self._condition(a)}, {self._condition(b)}"
        return Condition(*self._result(f"{operation} {operands}", a, b))

    def select(self, condition: Any, a: Any, b: Any) -> Any:
        """``a`` where a condition holds, else ``b``."""
        if isinstance(condition, bool | np.bool_):
            return a if condition else b
        operands = f"{self._numbers} {self._operand(a)}, {self._numbers} {self._operand(b)}"
        text = f"select {self._conditions} {self._condition(condition)}, {operands}"
        return Symbol(*self._result(text, condition, a, b))

    def _address(self, offset: int) -> str:
        return self._once(f"getelementptr double, ptr %here, i64 {offset}")

    def _operand(self, value: Any) -> str:
        if type(value) is Symbol:
            return self._name(value)
        if not isinstance(value, int | float):
            raise UntraceableError(f"a number and {value!r}")
        return f"splat (double 0x{struct.pack('>d', value).hex()})"

    def _condition(self, value: Any) -> str:
        if not isinstance(value, Condition):
            raise UntraceableError(f"a condition and {value!r}")
        return self._name(value)

    def _name(self, symbol: Symbol) -> str:
        if symbol.loop not in (None, self._loop):
            raise UntraceableError("a number of one lane in another")
        return symbol.name

    def _result(self, text: str, *operands: Any) -> tuple[Code, str, int | None]:
        of_lane = any(isinstance(a, Symbol) and a.loop is not None for a in operands)
        return self, self._once(text), self.loop if of_lane else None

    def _once(self, text: str) -> str:
        if text not in self._known:
            name = f"%v{len(self._known)}"
            self._lines.append(f"{name} = {text}")
            self._known[text] = name
        return self._known[text]


class Symbol:
    """Stands for a number of each lane, in a loop over lanes, or for one that is the same in all."""

    __slots__ = ("code", "loop", "name")
    __hash__ = None  # type: ignore[assignment]
    # Numbers of numpy leave operations with it to it.
    __array_ufunc__ = None

    def __init__(self, code: Code, name: str, loop: int | None) -> None:
        self.code, self.name, self.loop = code, name, loop

    def __bool__(self) -> bool:
        raise UntraceableError("a branch on a value")

    def __neg__(self) -> Symbol:
        return self.code.unary("fneg", self)

    def __abs__(self) -> Symbol:
        return self.code.magnitude(self)

    def __add__(self, other: Any) -> Symbol:
        return self if _is(0.0, other) else self.code.binary("fadd", self, other)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Symbol:
        return self if _is(0.0, other) else self.code.binary("fsub", self, other)

    def __rsub__(self, other: Any) -> Symbol:
        return -self if _is(0.0, other) else self.code.binary("fsub", other, self)

    def __mul__(self, other: Any) -> Symbol:
        return self if _is(1.0, other) else self.code.binary("fmul", self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Symbol:
        return self.code.binary("fdiv", self, other)

    def __rtruediv__(self, other: Any) -> Symbol:
        return self.code.binary("fdiv", other, self)

    def __pow__(self, n: Any) -> Symbol:
        if type(n) is not int or n < 1:
            raise UntraceableError(f"a power {n!r}")
        if n == 1:
            return self
        half = self ** (n // 2)
        return half * half * self if n % 2 else half * half

    def __lt__(self, other: Any) -> Condition:
        return self.code.compare("olt", self, other)

    def __le__(self, other: Any) -> Condition:
        return self.code.compare("ole", self, other)

    def __gt__(self, other: Any) -> Condition:
        return self.code.compare("ogt", self, other)

    def __ge__(self, other: Any) -> Condition:
        return self.code.compare("oge", self, other)

    def __eq__(self, other: Any) -> Condition:  # type: ignore[override]
        return self.code.compare("oeq", self, other)

    def __ne__(self, other: Any) -> Condition:  # type: ignore[override]
        return self.code.compare("une", self, other)


class Condition(Symbol):
    """Stands for whether something holds in each lane."""

    __slots__ = ()
    __hash__ = None

    def __and__(self, other: Any) -> Condition:
        return self.code.combine("and", self, other)

    def __or__(self, other: Any) -> Condition:
        return self.code.combine("or", self, other)


def _text(value: Any) -> str:
    return value.name if isinstance(value, Symbol) else repr(value)


def _is(number: float, value: Any) -> bool:
    # Without LLVM's flag for it, what is not finite times nothing is not nothing; the sign of zero is free.
    return isinstance(value, int | float) and value == number


class _Block:
    """Stands for a block, and knows what is in it: what is loaded, once, and what was stored last."""

    def __init__(self, code: Code) -> None:
        self._code = code
        self.known: dict[int, Any] = {}
        """The symbols or numbers at offsets."""
        self._stored: dict[int, int] = {}

    def __getitem__(self, place: Any) -> Any:
        offset = self._offset(place)
        if offset not in self.known:
            self.known[offset] = self._code.load(offset)
        value = self.known[offset]
        # It may have been put there in an earlier loop.
        return Symbol(self._code, value.name, self._code.loop) if isinstance(value, Symbol) else value

    def __setitem__(self, place: Any, value: Any) -> None:
        offset = self._offset(place)
        if offset in self._stored:
            self._code.leave_out(self._stored[offset])
        self._stored[offset] = self._code.store(offset, value)
        self.known[offset] = value if isinstance(value, Symbol) else float(value)

    def _offset(self, place: Any) -> int:
        if not (self._code.loop and isinstance(place, _Place)) or place.offset % self._code.lanes:
            raise UntraceableError(f"a number at {place!r}")
        return place.offset


class _Place:
    """Stands for the number of a lane, and what is added to it: only good to say where a number is."""

    def __init__(self, offset: int) -> None:
        self.offset = offset

    def __add__(self, further: int) -> _Place:
        return _Place(self.offset + further)

    __radd__ = __add__


class _Lanes(int):
    """The number of lanes, through which a range goes at once."""


def _range(code: Code, *bounds: int) -> Iterator[Any]:
    return code.each_lane() if isinstance(bounds[0], _Lanes) else iter(range(*bounds))


def trace(
    function: Callable[..., Any],
    together: int,
    flags: str,
    arguments: Callable[[Code], Sequence[Any]],
) -> Code:
    """The operations of a stage.

    Parameters
    ----------
    function
        The stage, in whose globals are constants, and compiled functions that know their text.
    together, flags
        As of :class:`Code`, at most.
    arguments
        Makes what the stage is called with: the code's block first, then its arguments.

    Raises
    ------
    UntraceableError
        If the function is no stage.
    """
    if LANES not in function.__code__.co_names:
        raise UntraceableError("no lanes")
    lanes = int(function.__globals__[LANES])
    code, again = (Code(lanes, math.gcd(lanes, together), flags, passes) for passes in (1, 2))
    for each in (code, again):
        try:
            result = _plain(function, each, {})(*arguments(each))
        except UntraceableError:
            raise
        except Exception as error:
            # A text that does other things with its arguments than a stage does may go wrong in any way.
            raise UntraceableError(repr(error)) from error
        if result is not None:
            raise UntraceableError("a result")
    if not code.does_as(again):
        raise UntraceableError("a number that counts lanes")
    return code


def _plain(function: Callable[..., Any], code: Code, made: dict[Hashable, Any]) -> Any:
    """The function that goes on symbols; ``made`` are those that there are already."""
    text = function.__code__
    if function not in made:
        scope: dict[str, Any] = {"range": partial(_range, code)}
        cells = tuple(CellType(cell.cell_contents) for cell in function.__closure__ or ())
        made[function] = FunctionType(text, scope, function.__name__, function.__defaults__, cells)
        for name in text.co_names:
            if name in function.__globals__:
                scope[name] = _stand_in(name, function.__globals__[name], code, made)
    return made[function]


def _stand_in(name: str, value: Any, code: Code, made: dict[Hashable, Any]) -> Any:
    """What stands for a global."""
    if value is np or value is math:
        return _functions(code)
    if isinstance(value, np.integer):
        return _Lanes(value) if name == LANES else int(value)
    text = getattr(value, "py_func", None)
    if text is None:
        return value
    return code.select if text is branch else _plain(text, code, made)


def _functions(code: Code) -> SimpleNamespace:
    """What stands for numpy and math: what formulas use of them."""

    def function(of_symbols: Callable[..., Any], plain: Callable[..., Any]) -> Callable[..., Any]:
        def of(*operands: Any) -> Any:
            traced = any(isinstance(a, Symbol) for a in operands)
            return of_symbols(*operands) if traced else plain(*operands)

        return of

    return SimpleNamespace(
        **{name: function(partial(code.call, name), getattr(math, name)) for name in ("sqrt", "exp", "log")},
        # Of no number and another LLVM's functions make no number, as numpy's do.
        maximum=function(code.maximum, max),
        minimum=function(partial(code.call, "minimum"), min),
        inf=math.inf,
        pi=math.pi,
    )
