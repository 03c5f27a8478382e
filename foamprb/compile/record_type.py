"""Type of records (:mod:`foamprb.compile.record`) in compiled code.

The function that Python calls writes the items of a record to its stack and passes their address. The module
uses numba's interface for extensions only.
"""

from __future__ import annotations

import functools
import hashlib
from typing import Any

from llvmlite import ir  # type: ignore[import-untyped]
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    NativeValue,
    infer_getattr,
    lower_getattr_generic,
    models,
    register_model,
    typeof_impl,
    unbox,
)

from foamprb.compile.record import RECORDS

__all__ = ["RecordType", "register_records"]

_registered: set[type[tuple[Any, ...]]] = set()


def register_records() -> None:
    """Make numba pass the classes of :data:`~foamprb.compile.record.RECORDS` by address."""
    for cls in RECORDS:
        if cls not in _registered:
            _registered.add(cls)
            typeof_impl.register(cls)(_typeof_record)


class RecordType(types.Type):  # type: ignore[misc]
    """Address of a record with items of these types."""

    def __init__(self, cls: type[Any], items: tuple[types.Type, ...]) -> None:
        self.items: dict[str, types.Type] = dict(zip(cls._fields, items, strict=True))
        # The name is part of the names of all compiled functions: short.
        digest = hashlib.sha256(repr((cls.__module__, *self.items.items())).encode()).hexdigest()[:12]
        super().__init__(name=f"{cls.__name__}_{digest}")


def _typeof_record(record: tuple[Any, ...], context: Any) -> RecordType:
    return RecordType(type(record), tuple(typeof_impl(item, context) for item in record))


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
def _unbox_record(record: RecordType, value: Any, c: Any) -> NativeValue:
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
def _read_item(context: Any, builder: Any, record: RecordType, address: Any, name: str) -> Any:
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


def _structure(context: Any, record: RecordType) -> Any:
    """Return the LLVM type of the memory at the address of a record."""
    return ir.LiteralStructType([_packed_type(context, item) for item in record.items.values()])


def _packed_type(context: Any, item: types.Type) -> Any:
    """Return the LLVM type of an item in memory: of a contiguous array, its address and shape."""
    if not _is_contiguous(item):
        return context.data_model_manager[item].get_data_type()
    return ir.LiteralStructType([cgutils.voidptr_t, ir.ArrayType(cgutils.intp_t, item.ndim)])


def _packed(context: Any, builder: Any, item: types.Type, value: Any) -> Any:
    """Return an item as it lies in memory."""
    if not _is_contiguous(item):
        return context.data_model_manager[item].as_data(builder, value)
    array = context.make_array(item)(context, builder, value)
    packed = ir.Constant(_packed_type(context, item), ir.Undefined)
    packed = builder.insert_value(packed, builder.bitcast(array.data, cgutils.voidptr_t), 0)
    return builder.insert_value(packed, array.shape, 1)


def _is_contiguous(item: types.Type) -> bool:
    return isinstance(item, types.Array) and item.layout == "C"


def _path(*indices: int) -> list[Any]:
    return [ir.Constant(ir.IntType(32), k) for k in indices]


def _load(builder: Any, place: Any, path: list[Any]) -> Any:
    """Load a constant from memory."""
    value = builder.load(builder.gep(place, path, inbounds=True))
    value.set_metadata("invariant.load", builder.module.add_metadata([]))
    return value
