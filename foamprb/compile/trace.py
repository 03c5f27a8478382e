"""Tracing of stages: a loop over lanes is executed once on symbols, which record LLVM code.

Stages do not branch on values, so one pass meets every operation. Equal operations are recorded once, on
registers of lanes. This skips the inference of types and the vectorisation of loops.

A stage to be traced consists of loops ``for i in range(LANES)``, by this name, over a block, whose rows of
LANES numbers are addressed as ``block[row * LANES + i]``.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Hashable, Iterator, Sequence
from functools import partial
from types import CellType, FunctionType, SimpleNamespace
from typing import Any, TypeAlias, TypeVar

import numpy as np

__all__ = ["LANES", "TRACED", "Code", "Numbers", "UntraceableError", "branch", "trace"]

LANES = "LANES"
"""Global name of the number of lanes in stages."""
TRACED = "_traced"
"""Attribute of stages to be traced."""


Path: TypeAlias = tuple[int | str, ...]
"""Index of an argument of a stage, and names or indices of items in it."""
Origin: TypeAlias = tuple[Path, int | None]
"""Path of a number, or of an array and the index of the number in it."""
T = TypeVar("T")


class UntraceableError(Exception):
    """Error: a function is not a stage."""


def branch(condition: object, a: T, b: T) -> T:
    """Select on numbers, see :func:`foamprb.body.tensor.select`: the only branch that can be traced."""
    return a if condition else b


class Code:
    """LLVM code of a stage.

    Parameters
    ----------
    lanes
        Lanes of a block.
    together
        Number of lanes in an operation, a divisor of ``lanes``.
    flags
        LLVM's flags of operations on floats.
    passes
        Number of times that a loop over lanes is executed, as if for other lanes.
    """

    def __init__(self, lanes: int, together: int, flags: str, passes: int = 1) -> None:
        self.lanes, self._together, self._flags, self._passes = lanes, together, flags, passes
        self._numbers, self._conditions = f"<{together} x double>", f"<{together} x i1>"
        self._lines: list[str] = []
        self._known: dict[str, str] = {}
        self._loops = self._loop = 0
        self._functions: dict[str, int] = {}
        self._origins: list[Origin] = []
        self.block = _Block(self)
        """Symbol of the block."""

    def argument(self, path: Path, item: int | None = None) -> Symbol:
        """Return the symbol of a number that all lanes share.

        It is found under a path among the arguments of the stage, or is an item of the array there.
        """
        origin = path, item
        if origin not in self._origins:
            self._origins.append(origin)
        return Symbol(self, f"%all{self._origins.index(origin)}", None)

    @property
    def arguments(self) -> tuple[Origin, ...]:
        """Path and item of the arguments after the block."""
        return tuple(self._origins)

    def function(self, name: str) -> str:
        """Return the LLVM text of a function of the block and the arguments."""
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
        """Yield the index of all lanes together."""
        before = self.block.current
        for _ in range(self._passes):
            self.block.current = dict(before)
            self._loops += 1
            self._loop = self._loops
            yield _Place(0)
        self._loop = 0

    def does_as(self, other: Code) -> bool:
        """Return True if another code has the same operations and leaves the same block."""
        mine, its = ({k: _text(v) for k, v in code.block.current.items()} for code in (self, other))
        return self._known == other._known and mine == its

    def load(self, offset: int) -> Symbol:
        """Return the symbol of the numbers at an offset before any store."""
        text = f"load {self._numbers}, ptr {self._address(offset)}, align 8"
        return Symbol(self, self._once(text), self.loop)

    def store(self, offset: int, value: object) -> int:
        """Record a store at an offset; return the index of its line."""
        operand = self._operand(value)
        self._lines.append(f"store {self._numbers} {operand}, ptr {self._address(offset)}, align 8")
        return len(self._lines) - 1

    def leave_out(self, line: int) -> None:
        """Delete a line."""
        self._lines[line] = ""

    @property
    def loop(self) -> int:
        """Index of the current loop over lanes.

        Raises
        ------
        UntraceableError
            Outside loops: a value of one lane is used after all lanes.
        """
        if self._loop == 0:
            raise UntraceableError("a value of one lane is used after the loop")
        return self._loop

    def unary(self, operation: str, a: object) -> Symbol:
        """Record an operation on numbers."""
        return Symbol(*self._result(f"{operation} {self._flags} {self._numbers} {self._operand(a)}", a))

    def binary(self, operation: str, a: object, b: object) -> Symbol:
        """Record an operation on two numbers."""
        start = f"{operation} {self._flags} {self._numbers}"
        text, turned = f"{start} {self._operand(a)}, {self._operand(b)}", ""
        if operation in ("fadd", "fmul"):
            turned = f"{start} {self._operand(b)}, {self._operand(a)}"
        return Symbol(*self._result(turned if turned in self._known else text, a, b))

    def call(self, function: str, *operands: object) -> Symbol:
        """Record a call of an LLVM function."""
        name = f"@llvm.{function}.v{self._together}f64"
        self._functions[name] = len(operands)
        arguments = ", ".join(f"{self._numbers} {self._operand(a)}" for a in operands)
        return Symbol(*self._result(f"call {self._flags} {self._numbers} {name}({arguments})", *operands))

    def compare(self, relation: str, a: object, b: object) -> Condition:
        """Record a comparison."""
        operands = f"{self._numbers} {self._operand(a)}, {self._operand(b)}"
        return Condition(*self._result(f"fcmp {self._flags} {relation} {operands}", a, b))

    def combine(self, operation: str, a: object, b: object) -> Condition:
        """Record ``and`` or ``or`` of two conditions."""
        operands = f"{self._conditions} {self._condition(a)}, {self._condition(b)}"
        return Condition(*self._result(f"{operation} {operands}", a, b))

    def select(self, condition: object, a: T, b: T) -> T | Symbol:
        """Record ``a`` where a condition holds, else ``b``."""
        if isinstance(condition, bool | np.bool_):
            return a if condition else b
        operands = f"{self._numbers} {self._operand(a)}, {self._numbers} {self._operand(b)}"
        text = f"select {self._conditions} {self._condition(condition)}, {operands}"
        return Symbol(*self._result(text, condition, a, b))

    def _address(self, offset: int) -> str:
        return self._once(f"getelementptr double, ptr %here, i64 {offset}")

    def _operand(self, value: object) -> str:
        if type(value) is Symbol:
            return self._name(value)
        if not isinstance(value, int | float):
            raise UntraceableError(f"{value!r} is used as a number")
        return f"splat (double 0x{struct.pack('>d', value).hex()})"

    def _condition(self, value: object) -> str:
        if not isinstance(value, Condition):
            raise UntraceableError(f"{value!r} is used as a condition")
        return self._name(value)

    def _name(self, symbol: Symbol) -> str:
        if symbol.loop not in (None, self._loop):
            raise UntraceableError("a value of one lane is used in another")
        return symbol.name

    def _result(self, text: str, *operands: object) -> tuple[Code, str, int | None]:
        of_lane = any(isinstance(a, Symbol) and a.loop is not None for a in operands)
        return self, self._once(text), self.loop if of_lane else None

    def _once(self, text: str) -> str:
        if text not in self._known:
            name = f"%v{len(self._known)}"
            self._lines.append(f"{name} = {text}")
            self._known[text] = name
        return self._known[text]


class Symbol:
    """Symbol of a number of each lane in a loop over lanes, or of a number that all lanes share."""

    __slots__ = ("code", "loop", "name")
    __hash__ = None  # type: ignore[assignment]
    # Makes numpy scalars defer to it.
    __array_ufunc__ = None

    def __init__(self, code: Code, name: str, loop: int | None) -> None:
        self.code, self.name, self.loop = code, name, loop

    def __bool__(self) -> bool:
        raise UntraceableError("it branches on a value")

    def __neg__(self) -> Symbol:
        return self.code.unary("fneg", self)

    def __abs__(self) -> Symbol:
        return self.code.call("fabs", self)

    def __add__(self, other: object) -> Symbol:
        return self if _is(0.0, other) else self.code.binary("fadd", self, other)

    __radd__ = __add__

    def __sub__(self, other: object) -> Symbol:
        return self if _is(0.0, other) else self.code.binary("fsub", self, other)

    def __rsub__(self, other: object) -> Symbol:
        return -self if _is(0.0, other) else self.code.binary("fsub", other, self)

    def __mul__(self, other: object) -> Symbol:
        return self if _is(1.0, other) else self.code.binary("fmul", self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Symbol:
        return self.code.binary("fdiv", self, other)

    def __rtruediv__(self, other: object) -> Symbol:
        return self.code.binary("fdiv", other, self)

    def __pow__(self, n: object) -> Symbol:
        if type(n) is not int or n < 1:
            raise UntraceableError(f"the power {n!r} is not an integer above 0")
        if n == 1:
            return self
        half = self ** (n // 2)
        return half * half * self if n % 2 else half * half

    def __lt__(self, other: object) -> Condition:
        return self.code.compare("olt", self, other)

    def __le__(self, other: object) -> Condition:
        return self.code.compare("ole", self, other)

    def __gt__(self, other: object) -> Condition:
        return self.code.compare("ogt", self, other)

    def __ge__(self, other: object) -> Condition:
        return self.code.compare("oge", self, other)

    def __eq__(self, other: object) -> Condition:  # type: ignore[override]
        return self.code.compare("oeq", self, other)

    def __ne__(self, other: object) -> Condition:  # type: ignore[override]
        return self.code.compare("une", self, other)


class Numbers:
    """Symbol of an array of numbers that all lanes share."""

    def __init__(self, code: Code, path: Path) -> None:
        self._code, self._path = code, path

    def __getitem__(self, item: object) -> Symbol:
        if not isinstance(item, int):
            raise UntraceableError(f"an array is indexed with {item!r}")
        return self._code.argument(self._path, item)


class Condition(Symbol):
    """Symbol of a condition of each lane."""

    __slots__ = ()
    __hash__ = None

    def __and__(self, other: object) -> Condition:
        return self.code.combine("and", self, other)

    def __or__(self, other: object) -> Condition:
        return self.code.combine("or", self, other)


def _text(value: object) -> str:
    return value.name if isinstance(value, Symbol) else repr(value)


def _is(number: float, value: object) -> bool:
    # Infinity times 0 is NaN, so products with 0 are kept; the sign of zero is free.
    return isinstance(value, int | float) and value == number


class _Block:
    """Symbol of a block, with the loaded and the last stored values."""

    def __init__(self, code: Code) -> None:
        self._code = code
        self.current: dict[int, Symbol | float] = {}
        """Symbols or numbers by offset."""
        self._stored: dict[int, int] = {}

    def __getitem__(self, place: object) -> Symbol | float:
        offset = self._offset(place)
        if offset not in self.current:
            self.current[offset] = self._code.load(offset)
        value = self.current[offset]
        # An earlier loop may have stored it.
        return Symbol(self._code, value.name, self._code.loop) if isinstance(value, Symbol) else value

    def __setitem__(self, place: object, value: Symbol | float) -> None:
        offset = self._offset(place)
        if offset in self._stored:
            self._code.leave_out(self._stored[offset])
        self._stored[offset] = self._code.store(offset, value)
        self.current[offset] = value if isinstance(value, Symbol) else float(value)

    def _offset(self, place: object) -> int:
        if not (self._code.loop and isinstance(place, _Place)) or place.offset % self._code.lanes:
            raise UntraceableError(f"the block is indexed with {place!r}")
        return place.offset


class _Place:
    """Symbol of the index of a lane plus an offset; it can only address the block."""

    def __init__(self, offset: int) -> None:
        self.offset = offset

    def __add__(self, further: int) -> _Place:
        return _Place(self.offset + further)

    __radd__ = __add__


class _Lanes(int):
    """Number of lanes; a range of it is traced once."""


def _range(code: Code, *bounds: int) -> Iterator[Any]:
    return code.each_lane() if isinstance(bounds[0], _Lanes) else iter(range(*bounds))


def trace(
    function: Callable[..., Any],
    together: int,
    flags: str,
    arguments: Callable[[Code], Sequence[object]],
) -> Code:
    """Return the LLVM code of a stage.

    Parameters
    ----------
    function
        The stage, with constants and numba dispatchers in its globals.
    together, flags
        As in :class:`Code`; ``together`` is an upper bound.
    arguments
        Returns the arguments of the stage for a code: its block, then symbols.

    Raises
    ------
    UntraceableError
        If the function is not a stage.
    """
    if LANES not in function.__code__.co_names:
        raise UntraceableError("it has no loop over LANES")
    lanes = int(function.__globals__[LANES])
    code, again = (Code(lanes, math.gcd(lanes, together), flags, passes) for passes in (1, 2))
    for each in (code, again):
        try:
            result = _plain(function, each, {})(*arguments(each))
        except UntraceableError:
            raise
        except Exception as error:
            # A function that is not a stage may fail in any way on symbols.
            raise UntraceableError(repr(error)) from error
        if result is not None:
            raise UntraceableError("it returns a value")
    if not code.does_as(again):
        raise UntraceableError("it counts lanes")
    return code


def _plain(function: Callable[..., Any], code: Code, made: dict[Hashable, FunctionType]) -> FunctionType:
    """Return a function on symbols; ``made`` holds the functions made so far."""
    text = function.__code__
    if function not in made:
        scope: dict[str, Any] = {"range": partial(_range, code)}
        captured = zip(text.co_freevars, function.__closure__ or (), strict=True)
        cells = tuple(CellType(_stand_in(name, cell.cell_contents, code, made)) for name, cell in captured)
        made[function] = FunctionType(text, scope, function.__name__, function.__defaults__, cells)
        for name in text.co_names:
            if name in function.__globals__:
                scope[name] = _stand_in(name, function.__globals__[name], code, made)
    return made[function]


def _stand_in(name: str, value: Any, code: Code, made: dict[Hashable, FunctionType]) -> Any:
    """Return the value of a global for symbols."""
    if value is np or value is math:
        return _functions(code)
    if isinstance(value, np.integer):
        return _Lanes(value) if name == LANES else int(value)
    text = getattr(value, "py_func", None)
    if text is None:
        return value
    return code.select if text is branch else _plain(text, code, made)


def _functions(code: Code) -> SimpleNamespace:
    """Return the functions of numpy and math that formulas use, for symbols."""

    def function(of_symbols: Callable[..., Any], plain: Callable[..., Any]) -> Callable[..., Any]:
        def of(*operands: object) -> Any:
            traced = any(isinstance(a, Symbol) for a in operands)
            return of_symbols(*operands) if traced else plain(*operands)

        return of

    return SimpleNamespace(
        **{name: function(partial(code.call, name), getattr(math, name)) for name in ("sqrt", "exp", "log")},
        # With NaN, LLVM's functions return NaN, as in numpy.
        maximum=function(partial(code.call, "maximum"), max),
        minimum=function(partial(code.call, "minimum"), min),
        inf=math.inf,
        pi=math.pi,
    )
