"""Types of arguments that compiled code takes by address.

The function that Python calls writes the items of a record (:mod:`foamprb.compile.record`) to its stack and
passes their address. The address of a :class:`Packed` argument has the same type whatever it holds: functions
that only pass it on do not depend on its content. The module uses numba's interface for extensions only.
"""

from __future__ import annotations

import functools
import hashlib
import operator
import struct
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]
from numba import typeof, types
from numba.core import cgutils
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_global, signature
from numba.extending import (
    NativeValue,
    infer_getattr,
    intrinsic,
    lower_builtin,
    lower_getattr_generic,
    models,
    register_model,
    typeof_impl,
    unbox,
)

from foamprb.compile.record import RECORDS

if TYPE_CHECKING:
    from numba.core.base import BaseContext
    from numba.core.pythonapi import UnboxContext
    from numba.core.typing.templates import Signature

__all__ = ["Packed", "RecordType", "read_item", "register_records", "unpack_as"]

_registered: set[type[tuple[object, ...]]] = set()


def register_records() -> None:
    """Make numba pass the classes of :data:`~foamprb.compile.record.RECORDS` by address."""
    for cls in RECORDS:
        if cls not in _registered:
            _registered.add(cls)
            typeof_impl.register(cls)(_typeof_record)


@functools.cache
def register_stand_in(cls: type) -> None:
    """Make numba use a class of :func:`~foamprb.compile.record.stand_in`."""

    class Template(AbstractTemplate):  # type: ignore[misc]
        def generic(self, items: tuple[types.Type, ...], _kws: object) -> Signature:
            return signature(StandInType(cls, items), *items)

    infer_global(cls)(Template)
    lower_builtin(cls, types.VarArg(types.Any))(_made)


class StandInType(types.Type):  # type: ignore[misc]
    """Object that stands in for a record, or for a table, with items of these types."""

    def __init__(self, cls: type[Any], items: tuple[types.Type, ...]) -> None:
        self.cls, self.items = cls, dict(zip(cls.item_names, items, strict=True))
        code = getattr(getattr(cls, "item", None), "__code__", None)
        content = repr((cls.__module__, *self.items.items(), code and (code.co_code, code.co_consts)))
        super().__init__(name=f"{cls.__name__}_{hashlib.sha256(content.encode()).hexdigest()[:12]}")


@register_model(StandInType)
class _StandInModel(models.StructModel):  # type: ignore[misc]
    """Its items."""

    def __init__(self, manager: models.DataModelManager, kind: StandInType) -> None:
        super().__init__(manager, kind, list(kind.items.items()))


def _made(context: BaseContext, builder: ir.IRBuilder, made: Any, values: Any) -> Any:
    """Return a new object."""
    new = cgutils.create_struct_proxy(made.return_type)(context, builder)
    for name, value, given, kind in zip(
        made.return_type.items, values, made.args, made.return_type.items.values(), strict=True
    ):
        setattr(new, name, context.cast(builder, value, given, kind))
    return new._getvalue()


@infer_getattr
class _StandInItems(AttributeTemplate):  # type: ignore[misc]
    key = StandInType

    def generic_resolve(self, kind: StandInType, name: str) -> types.Type | None:
        """Return the type of an item, or of one of its base."""
        base = kind.items.get("base")
        return kind.items.get(name) or (None if base is None else base.items.get(name))


@lower_getattr_generic(StandInType)  # type: ignore[untyped-decorator]
def _read_stand_in(context: BaseContext, builder: Any, kind: StandInType, value: Any, name: str) -> Any:
    items = cgutils.create_struct_proxy(kind)(context, builder, value)
    if name in kind.items:
        return getattr(items, name)
    return read_item(context, builder, kind.items["base"], items.base, name)


@infer_global(operator.getitem)
class _Element(AbstractTemplate):  # type: ignore[misc]
    def generic(self, args: Sequence[types.Type], _kws: object) -> Signature | None:
        """Return the types of an element of a stand-in for a table."""
        if isinstance(args[0], StandInType):
            return signature(types.float64, args[0], types.UniTuple(types.int64, 2))
        return None


@lower_builtin(operator.getitem, StandInType, types.BaseTuple)  # type: ignore[untyped-decorator]
def _read_element(context: BaseContext, builder: ir.IRBuilder, asked: Any, values: Any) -> Any:
    table, place = values
    i, j = (builder.extract_value(place, k) for k in range(2))
    made = types.float64(asked.args[0], types.int64, types.int64)
    return context.compile_internal(builder, asked.args[0].cls.item, made, (table, i, j))


class RecordType(types.Type):  # type: ignore[misc]
    """Address of a record with items of these types."""

    def __init__(self, cls: type[Any], items: tuple[types.Type, ...]) -> None:
        self.items: dict[str, types.Type] = dict(zip(cls._fields, items, strict=True))
        # The name is part of the names of all compiled functions: short.
        digest = hashlib.sha256(repr((cls.__module__, *self.items.items())).encode()).hexdigest()[:12]
        super().__init__(name=f"{cls.__name__}_{digest}")


_record_type = functools.cache(RecordType)
_record_types: dict[tuple[object, ...], RecordType] = {}
"""By the class of a record and the :func:`_sort_of` its items."""


def _typeof_record(record: tuple[object, ...], context: BaseContext) -> RecordType:
    """Return the type of a record. Those of its items, which numba makes anew each time, are asked once."""
    sort = _sort_of(record)
    if sort not in _record_types:
        _record_types[sort] = _record_type(type(record), tuple(typeof_impl(item, context) for item in record))
    return _record_types[sort]


def _sort_of(item: object) -> tuple[object, ...]:
    """Return what two items have in common if they are of the same type to numba."""
    if isinstance(item, np.ndarray):
        return item.dtype, item.ndim, item.flags.num
    if isinstance(item, tuple):
        return type(item), *map(_sort_of, item)
    return (type(item),)


@register_model(RecordType)
class _RecordModel(models.OpaqueModel):  # type: ignore[misc]
    """An untyped address."""


@infer_getattr
class _Items(AttributeTemplate):  # type: ignore[misc]
    key = RecordType

    def generic_resolve(self, record: RecordType, name: str) -> types.Type | None:
        """Return the type of an item, None if there is none of this name."""
        return record.items.get(name)


@unbox(RecordType)  # type: ignore[untyped-decorator]
def _unbox_record(record: RecordType, value: ir.Value, c: UnboxContext) -> NativeValue:
    place = cgutils.alloca_once(c.builder, _structure(c.context, record))
    failed, cleanups = cgutils.false_bit, []
    for k, item in enumerate(record.items.values()):
        native = c.unbox(item, c.pyapi.tuple_getitem(value, k))
        failed = c.builder.or_(failed, native.is_error)
        if native.cleanup is not None:
            cleanups.append(native.cleanup)
        c.builder.store(_packed(c.context, c.builder, item, native.value), c.builder.gep(place, _path(0, k)))
    address = c.builder.bitcast(place, cgutils.voidptr_t)
    # Hides from the optimiser that the memory was just written: loads from it are marked as invariant.
    kind = ir.FunctionType(address.type, [address.type])
    address = c.builder.asm(kind, "", "=r,0,~{memory}", [address], True)

    def cleanup() -> None:
        for clean in reversed(cleanups):
            clean()

    return NativeValue(address, is_error=failed, cleanup=cleanup if cleanups else None)


@lower_getattr_generic(RecordType)  # type: ignore[untyped-decorator]
def read_item(context: BaseContext, builder: Any, record: RecordType, address: Any, name: str) -> Any:
    """Return an item of a record."""
    place = builder.bitcast(address, _structure(context, record).as_pointer())
    path, item = _path(0, list(record.items).index(name)), record.items[name]
    model = context.data_model_manager[item]
    if not _is_contiguous(item):
        return model.from_data(builder, _load(builder, place, path))
    number = context.get_data_type(item.dtype)
    shape = [_load(builder, place, [*path, *_path(1, axis)]) for axis in range(item.ndim)]
    size = ir.Constant(cgutils.intp_t, context.get_abi_sizeof(number))
    strides = [size]
    for extent in reversed(shape[1:]):
        strides.insert(0, builder.mul(strides[0], extent))
    # Every member that kernels use; they own no array, and none asks for its size in bytes.
    members = {
        "data": builder.bitcast(_load(builder, place, [*path, *_path(0)]), number.as_pointer()),
        "itemsize": size,
        "nitems": functools.reduce(builder.mul, shape),
        "shape": cgutils.pack_array(builder, shape),
        "strides": cgutils.pack_array(builder, strides),
    }
    array = ir.Constant(model.get_value_type(), None)
    for member, value in members.items():
        array = model.set(builder, array, value, member)
    return array


def _structure(context: BaseContext, record: RecordType) -> ir.Type:
    """Return the LLVM type of the memory at the address of a record."""
    return ir.LiteralStructType([_packed_type(context, item) for item in record.items.values()])


def _packed_type(context: BaseContext, item: types.Type) -> ir.Type:
    """Return the LLVM type of an item in memory: of a contiguous array, its address and shape."""
    if not _is_contiguous(item):
        return context.data_model_manager[item].get_data_type()
    return ir.LiteralStructType([cgutils.voidptr_t, ir.ArrayType(cgutils.intp_t, item.ndim)])


def _packed(context: BaseContext, builder: ir.IRBuilder, item: types.Type, value: ir.Value) -> ir.Value:
    """Return an item as it lies in memory."""
    if not _is_contiguous(item):
        return context.data_model_manager[item].as_data(builder, value)
    array = context.make_array(item)(context, builder, value)
    packed = ir.Constant(_packed_type(context, item), ir.Undefined)
    packed = builder.insert_value(packed, builder.bitcast(array.data, cgutils.voidptr_t), 0)
    return builder.insert_value(packed, array.shape, 1)


def _is_contiguous(item: types.Type) -> bool:
    return isinstance(item, types.Array) and item.layout == "C"


def _path(*indices: int) -> list[ir.Constant]:
    return [ir.Constant(ir.IntType(32), k) for k in indices]


def _load(builder: ir.IRBuilder, place: ir.Value, path: list[ir.Constant]) -> ir.Value:
    """Load a constant from memory."""
    value = builder.load(builder.gep(place, path, inbounds=True))
    value.set_metadata("invariant.load", builder.module.add_metadata([]))
    return value


class _PackedType(types.Type):  # type: ignore[misc]
    """Address of an argument of any type."""

    def __init__(self) -> None:
        super().__init__(name="Packed")


_PACKED = _PackedType()


class Packed:
    """Argument in memory, in the form in which compiled functions read it after :func:`unpack_as`.

    Parameters
    ----------
    argument
        A record, or a tuple; of arrays, numbers, and others like it.

    Raises
    ------
    TypeError
        For items of other types.
    """

    def __init__(self, argument: Any) -> None:
        self.layout: types.Type = typeof(argument)
        self._held: list[object] = [argument]
        words = self._record(argument) if isinstance(self.layout, RecordType) else self._words(argument)
        self._memory = np.frombuffer(words or bytes(8), dtype=np.uint8).copy()
        self.address = self._memory.ctypes.data

    def _record(self, items: tuple[object, ...]) -> bytes:
        """Return the items of a record, see :func:`_structure`."""
        return b"".join(map(self._item, items))

    def _item(self, item: Any) -> bytes:
        if isinstance(item, np.ndarray) and item.flags.c_contiguous:
            return struct.pack(f"{1 + item.ndim}q", item.ctypes.data, *item.shape)
        return self._words(item)

    def _words(self, item: Any) -> bytes:
        """Return an item as numba has it in memory."""
        if isinstance(item, np.ndarray):
            owner = (0, 0, item.size, item.itemsize)
            return struct.pack(f"{5 + 2 * item.ndim}q", *owner, item.ctypes.data, *item.shape, *item.strides)
        if type(item) in _registered:
            inner = Packed(item)
            self._held.append(inner)
            return struct.pack("q", inner.address)
        if isinstance(item, tuple):
            return b"".join(map(self._words, item))
        kind = typeof(item)
        if kind == types.int64:
            return struct.pack("q", int(item))
        if kind == types.float64:
            return struct.pack("d", float(item))
        if kind == types.complex128:
            return struct.pack("2d", item.real, item.imag)
        raise TypeError(f"{item!r} is of the type {kind}, which no kernel takes by address")


@typeof_impl.register(Packed)  # type: ignore[untyped-decorator]
def _typeof_packed(_argument: Packed, _context: object) -> types.Type:
    return _PACKED


@register_model(_PackedType)
class _PackedModel(models.OpaqueModel):  # type: ignore[misc]
    """An untyped address."""


@unbox(_PackedType)  # type: ignore[untyped-decorator]
def _unbox_packed(_kind: object, argument: ir.Value, c: UnboxContext) -> NativeValue:
    number = c.pyapi.object_getattr_string(argument, "address")
    address = c.builder.inttoptr(c.pyapi.long_as_longlong(number), cgutils.voidptr_t)
    c.pyapi.decref(number)
    return NativeValue(address)


@functools.cache
def unpack_as(layout: types.Type) -> Callable[[Any], Any]:
    """Return a function of compiled code that returns an argument of some type from its address."""

    @intrinsic  # type: ignore[untyped-decorator]
    def unpack(_typing: object, argument: Any) -> Any:
        def read(context: BaseContext, builder: ir.IRBuilder, _signature: object, values: Any) -> Any:
            if isinstance(layout, RecordType):
                return values[0]
            place = builder.bitcast(values[0], context.get_data_type(layout).as_pointer())
            return context.data_model_manager[layout].load_from_data_pointer(builder, place)

        return layout(argument), read

    return unpack  # type: ignore[no-any-return]
