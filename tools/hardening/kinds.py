"""Kinds of damage to the files of a case: by name, what is done, and whether the files show it.

A case is a dictionary of its files: name → content, or what stands in its place (:class:`Odd`). Every change
is a function of such a dictionary that returns another one.
"""

from __future__ import annotations

import gzip
import re
from collections.abc import Callable, Iterator
from typing import NamedTuple, TypeAlias


class Odd(str):
    """What stands in the place of a file: ``folder``, ``fifo``, ``link NAME`` or ``forbidden``."""

    __slots__ = ()


Files: TypeAlias = dict[str, bytes | Odd]
Change: TypeAlias = Callable[[Files], Files]


class Kind(NamedTuple):
    """A kind of damage."""

    change: Change
    visible: bool = True
    """Whether the files show that something is wrong."""
    words: tuple[str, ...] = ()
    """Further words of the command line."""


POLY = "constant/polyMesh/"
MESH = tuple(POLY + name for name in ("points", "faces", "owner", "neighbour", "boundary"))
FIELD = "1/U"
SETTINGS = "constant/softCloudProperties"
PROPERTIES = "constant/transportProperties"
GRAVITY = "constant/g"
POSITIONS = "constant/positions"
FILES = (*MESH, FIELD, SETTINGS, PROPERTIES, GRAVITY, POSITIONS)
LISTS = (*MESH, FIELD)


def put(name: str, content: bytes | Odd) -> Change:
    """Put a file in the place of another."""
    return lambda files: {**files, name: content}


def without(name: str) -> Change:
    """Remove a file."""
    return lambda files: {n: content for n, content in files.items() if n != name}


def edit(name: str, change: Callable[[bytes], bytes]) -> Change:
    """Change the content of a file."""

    def changed(files: Files) -> Files:
        content = files.get(name, b"")
        if isinstance(content, Odd) or change(content) == content:
            return files
        return {**files, name: change(content)}

    return changed


def swap(name: str, pattern: str, by: str) -> Change:
    """Replace what first fits a pattern."""
    return edit(name, lambda text: re.sub(pattern.encode(), by.encode(), text, count=1, flags=re.DOTALL))


def add(name: str, text: str) -> Change:
    """Add lines at the end of a file."""
    return edit(name, lambda content: content + text.encode())


def both(*changes: Change) -> Change:
    """One change after the other."""

    def all_of(files: Files) -> Files:
        for change in changes:
            files = change(files)
        return files

    return all_of


def packed(name: str, change: Callable[[bytes], bytes]) -> Change:
    """Put a compressed copy of a file, changed, beside it."""

    def beside(files: Files) -> Files:
        content = files.get(name, b"")
        if isinstance(content, Odd):
            return files
        return {**files, name + ".gz": change(gzip.compress(content, mtime=0))}

    return beside


def copied(source: str, to: str) -> Change:
    """Copy a file."""
    return lambda files: {**files, to: files[source]} if source in files else files


def row(text: bytes, at: int, new: bytes | None) -> bytes:
    """Replace the row of numbers with that index in the first list of a file, or remove it."""
    lines = text.split(b"\n")
    rows = [i for i, line in enumerate(lines) if re.match(rb"\s*(\d+\()?\(?[-\d]", line)]
    # The first is the length of the list.
    place = rows[1 + at] if len(rows) > 1 + at else rows[-1]
    return b"\n".join(lines[:place] + ([] if new is None else [new]) + lines[place + 1 :])


def number(text: bytes, new: str) -> bytes:
    """Replace the last number of the second row of the first list."""
    lines = text.split(b"\n")
    rows = [i for i, line in enumerate(lines) if re.match(rb"\s*(\d+\()?\(?[-\d]", line)]
    place = rows[min(2, len(rows) - 1)]
    lines[place] = re.sub(rb"[-+.\de]+(?=\D*$)", new.encode(), lines[place], count=1)
    return b"\n".join(lines)


def _in_every_file() -> Iterator[tuple[str, Kind]]:
    for name in FILES:
        short = name.rpartition("/")[2]
        yield f"{short}: missing", Kind(without(name))
        yield f"{short}: empty", Kind(put(name, b""))
        yield f"{short}: a folder", Kind(put(name, Odd("folder")))
        yield f"{short}: a pipe that nobody writes to", Kind(put(name, Odd("fifo")))
        yield f"{short}: a link to itself", Kind(put(name, Odd(f"link {short}")))
        yield f"{short}: a link to /dev/zero", Kind(put(name, Odd("link /dev/zero")))
        yield f"{short}: cut in the middle", Kind(edit(name, lambda text: text[: len(text) // 2]))
        yield (
            f"{short}: a block of zeros",
            Kind(edit(name, lambda text: text[: len(text) // 2] + bytes(64) + text[len(text) // 2 + 64 :])),
        )
        yield f"{short}: ends in a bomb", Kind(both(packed(name, lambda _: bomb()), without(name)))


def _in_lists() -> Iterator[tuple[str, Kind]]:
    for name in LISTS:
        short = name.rpartition("/")[2]
        yield (
            f"{short}: last line missing",
            Kind(edit(name, lambda text: text.rstrip().rpartition(b"\n")[0] + b"\n")),
        )
        if name == POLY + "boundary":
            continue
        yield f"{short}: a row missing", Kind(edit(name, lambda text: row(text, 1, None)))
        yield f"{short}: a length too large", Kind(swap(name, r"(\n|> )(\d+)\n\(", r"\g<1>99\n("))
        yield f"{short}: a length of 4e9", Kind(swap(name, r"(\n|> )(\d+)\n\(", r"\g<1>4000000000\n("))
        yield f"{short}: a negative length", Kind(swap(name, r"(\n|> )(\d+)\n\(", r"\1-8\n("))
        for new in ("nan", "1e400", "x", "99999", "-7"):
            visible = not (name in (POLY + "points", FIELD) and new in ("99999", "-7"))
            yield f"{short}: {new} for a number", Kind(edit(name, lambda t, new=new: number(t, new)), visible)


def bomb() -> bytes:
    """A compressed file of a thousand times its size."""
    return gzip.compress(b" " * (1 << 29), 9, mtime=0)


FLOOR = r"floor \{ type fixedValue; value nonuniform.*?\)\n;\n\}"
VELOCITY = r"dimensions \[[^]]*\];"


def _of_the_flow() -> Iterator[tuple[str, Kind]]:
    yield (
        "U and a U.gz of other values",
        Kind(
            lambda files: packed(
                FIELD, lambda _: gzip.compress(_plain(files, FIELD).replace(b"(1.", b"(7."), mtime=0)
            )(files)
        ),
    )
    yield "U and a U.gz that is cut", Kind(packed(FIELD, lambda data: data[: len(data) // 2]))
    yield "points and a points.gz that is cut", Kind(packed(POLY + "points", lambda data: data[:40]))
    yield "owner and an owner.gz that is none", Kind(packed(POLY + "owner", lambda _: b"no gzip"))
    yield (
        "only a U.gz that is cut",
        Kind(both(packed(FIELD, lambda data: data[: len(data) // 2]), without(FIELD))),
    )
    yield (
        "only a U.gz with a wrong checksum",
        Kind(both(packed(FIELD, lambda data: data[:-8] + bytes(8)), without(FIELD))),
    )
    yield "times 1 and 1.0", Kind(copied(FIELD, "1.0/U"))
    yield "a later time without U", Kind(put("2/p", b"x"))
    yield "a later time with an empty U", Kind(put("2/U", b""))
    yield "a later time with half a U", Kind(lambda files: {**files, "2/U": _plain(files, FIELD)[:300]})
    for name, power in (("a mass flux", "1 -2 -1"), ("a flux", "0 3 -1"), ("a pressure", "0 2 -2")):
        yield f"U has the dimensions of {name}", Kind(swap(FIELD, VELOCITY, f"dimensions [{power} 0 0 0 0];"))
    yield "U has no dimensions", Kind(swap(FIELD, VELOCITY, ""))
    yield "U has dimensions of two numbers", Kind(swap(FIELD, VELOCITY, "dimensions [0 1];"))
    yield "U is a scalar field", Kind(swap(FIELD, "volVectorField", "volScalarField"))
    yield "U is a field of points", Kind(swap(FIELD, "volVectorField", "pointVectorField"))
    yield "U says binary", Kind(swap(FIELD, "format ascii", "format binary"))
    yield "points say binary", Kind(swap(POLY + "points", "format ascii", "format binary"))
    yield "points are a list of labels", Kind(swap(POLY + "points", "vectorField", "labelList"))
    yield "U without a patch", Kind(swap(FIELD, FLOOR, ""))
    yield "U with a patch that the mesh has not", Kind(swap(FIELD, r"floor \{", "flor {"))
    yield "a fixedValue without value", Kind(swap(FIELD, FLOOR, "floor { type fixedValue; }"))
    yield "an unknown condition without value", Kind(swap(FIELD, FLOOR, "floor { type noSlp; }"))
    yield "a condition without type", Kind(swap(FIELD, FLOOR, "floor { value uniform (0 0 0); }"))
    yield "a value that is a scalar", Kind(swap(FIELD, FLOOR, "floor { type fixedValue; value uniform 0; }"))
    yield "a value of too few rows", Kind(edit(FIELD, lambda text: row(text, 9, None)))
    yield "internalField missing", Kind(swap(FIELD, r"internalField.*?\)\n;", ""))
    yield (
        "internalField uniform without vector",
        Kind(swap(FIELD, r"internalField.*?\)\n;", "internalField uniform;")),
    )
    yield (
        "internalField that names itself",
        Kind(swap(FIELD, r"internalField.*?\)\n;", "internalField $internalField;")),
    )
    yield "U that includes itself", Kind(swap(FIELD, "internalField", '#include "U"\ninternalField'))
    yield (
        "U that includes /dev/zero",
        Kind(swap(FIELD, "internalField", '#include "/dev/zero"\ninternalField')),
    )


def _of_the_mesh() -> Iterator[tuple[str, Kind]]:
    boundary, points, faces = POLY + "boundary", POLY + "points", POLY + "faces"
    for name in ("../../../../pwn", "..", ".", "a/b", "a b", "a;b"):
        yield f"a patch named {name}", Kind(both(swap(boundary, "floor", name), swap(FIELD, "floor", name)))
    yield "a patch type wal", Kind(swap(boundary, "type wall", "type wal"))
    yield (
        "a curved symmetryPlane",
        Kind(both(swap(boundary, r"sides([^{]*)\{ type wall", r"sides\1{ type symmetryPlane"))),
    )
    yield "an empty patch in three dimensions", Kind(swap(boundary, "type wall", "type empty"))
    yield "a cyclic patch without neighbour", Kind(swap(boundary, "type wall", "type cyclic"))
    yield "a patch without type", Kind(swap(boundary, "type wall;", ""))
    yield "a patch without nFaces", Kind(swap(boundary, "nFaces 4;", ""))
    yield "two patches of one name", Kind(swap(boundary, "lid", "floor"))
    yield "patches that overlap", Kind(swap(boundary, "startFace 16", "startFace 14"))
    yield "patches with a gap", Kind(swap(boundary, "nFaces 4; startFace 16", "nFaces 3; startFace 16"))
    yield "patches beyond the faces", Kind(swap(boundary, "nFaces 16", "nFaces 19"))
    yield "a patch of negative size", Kind(swap(boundary, "nFaces 4", "nFaces -4"))
    yield "a face turned round", Kind(edit(faces, _turned))
    yield "a face with a point twice", Kind(edit(faces, _doubled))
    yield "two faces exchanged", Kind(edit(faces, _exchanged))
    yield "a face of two points", Kind(edit(faces, lambda text: row(text, 3, b"2(1 2)")))
    yield "a cell without volume", Kind(edit(points, lambda text: _moved(text, _flattened)))
    yield "a cell inside out", Kind(edit(points, lambda text: _moved(text, _crossed)))
    yield "a point at infinity", Kind(edit(points, lambda text: _moved(text, lambda _: {0: (1e30, 0, 0)})))
    yield (
        "all points the same",
        Kind(edit(points, lambda text: _moved(text, lambda x: dict.fromkeys(x, (0, 0, 0))))),
    )
    yield (
        "all points in a plane",
        Kind(edit(points, lambda text: _moved(text, lambda x: {k: (p[0], p[1], 0.0) for k, p in x.items()}))),
    )
    yield (
        "owner and neighbour exchanged",
        Kind(
            lambda files: {
                **files,
                POLY + "owner": files[POLY + "neighbour"],
                POLY + "neighbour": files[POLY + "owner"],
            }
        ),
    )
    yield "neighbour is the owner", Kind(edit(POLY + "neighbour", lambda text: row(text, 0, b"0")))
    yield (
        "points and faces exchanged",
        Kind(lambda files: {**files, points: files[faces], faces: files[points]}),
    )
    # What no file shows.
    yield (
        "points all scaled by 1.001",
        Kind(
            edit(
                points,
                lambda text: _moved(text, lambda x: {k: tuple(1.001 * v for v in p) for k, p in x.items()}),
            ),
            visible=False,
        ),
    )
    yield (
        "an inner point moved a little",
        Kind(
            edit(points, lambda text: _moved(text, lambda x: {13: tuple(v + 0.01 for v in x[13])})),
            visible=False,
        ),
    )
    yield "the velocities shifted by a cell", Kind(edit(FIELD, _shifted), visible=False)
    yield "a digit of a velocity", Kind(swap(FIELD, r"\(1\.47", "(1.57"), visible=False)
    yield (
        "two patches of one type exchanged in the field",
        Kind(
            both(
                swap(FIELD, r"\nfloor", "\nFLOOR"),
                swap(FIELD, r"\nlid", "\nfloor"),
                swap(FIELD, r"\nFLOOR", "\nlid"),
            ),
            visible=False,
        ),
    )


def _of_the_settings() -> Iterator[tuple[str, Kind]]:
    yield (
        "nu without dimensions of a viscosity",
        Kind(put(PROPERTIES, b"transportModel Newtonian;\nnu [1 -1 -1 0 0 0 0] 1.5e-5;\n")),
    )
    yield "nu missing", Kind(put(PROPERTIES, b"transportModel Newtonian;\n"))
    yield "nu negative", Kind(put(PROPERTIES, b"nu -1;"))
    yield "nu nan", Kind(put(PROPERTIES, b"nu nan;"))
    yield "an unknown transportModel", Kind(put(PROPERTIES, b"transportModel Newtonan;\nnu 1.5e-5;\n"))
    yield "g with dimensions of a velocity", Kind(swap(GRAVITY, "0 1 -2", "0 1 -1"))
    yield "g of two components", Kind(swap(GRAVITY, r"\(0 0 -9.81\)", "(0 -9.81)"))
    yield "g without value", Kind(swap(GRAVITY, "value[^;]*;", ""))
    for what, text in (
        ("outside", "(5 5 5)"), ("nan", "(nan 0 0)"), ("of two numbers", "(0.3 0.4)"),
        ("of words", "(a b c)"), ("without bracket", "0.3 0.4 0.5"), ("infinite", "(inf 0 0)"),
    ):  # fmt: skip
        yield f"a position {what}", Kind(swap(POSITIONS, r"\(0\.3 0\.4 0\.5\)", text))
    yield "positions that end early", Kind(swap(POSITIONS, r"\)\s*$", ""))
    yield "positions with a length that is wrong", Kind(swap(POSITIONS, r"^\(", "7\n("))
    yield "a position twice", Kind(swap(POSITIONS, r"\(0\.7 0\.2 0\.9\)", "(0.3 0.4 0.5)"), visible=False)
    for entry, values in {
        "deltaT": ("1e-320", "0", "-1e-4", "nan", "1e400", "x", "1e-4 1e-4"),
        "endTime": ("1e300", "-1", "nan", "inf", "0", "x"),
    }.items():
        for value in values:
            yield f"{entry} {value}", Kind(swap(SETTINGS, rf"{entry} [^;]*;", f"{entry} {value};"))
    for before, after, what in (
        ("deltaT", "deltat", "a keyword in another spelling"),
        ("type oberbeck", "type oberbek", "a model in another spelling"),
        ("rho0 1000;", "", "an entry missing"),
        ("rho0 1000", "rho0 [0 1 -1 0 0 0 0] 1000", "an entry of other dimensions"),
        ("rho0 1000", "rho0 -1000", "a negative density"),
        ("rho0 1000", "rho0 $missing", "a macro that is not there"),
        ("rho0 1000;", "a $b; b $a; rho0 $a;", "macros that name each other"),
        ("rho0 1000;", "#include \"/etc/passwd\"\nrho0 1000;", "a file of another kind included"),
        ("rho0 1000;", "#include \"missing\"\nrho0 1000;", "a missing file included"),
        ("rho0 1000;", "#include \"/dev/zero\"\nrho0 1000;", "a device included"),
        ("rho0 1000;", "#include \"softCloudProperties\"\nrho0 1000;", "the file includes itself"),
        ("rho0 1000", "rho0 #calc \"1/0\"", "a calculation"),
        ("rho0 1000", "rho0 #eval{ 1/0 }", "a division by zero"),
        ("poissonsRatio 0.499", "poissonsRatio 0.5", "an incompressible solid"),
        ("value 1e-3", "value 0", "a radius of zero"),
        ("value 1e-3", "value 1e3", "a radius larger than the mesh"),
        ("value 1e-3", "value -1e-3", "a negative radius"),
        ("e 1;", "e 7;", "a restitution above one"),
        ('".*"', '"flor"', "a pattern that fits no patch"),
        ('".*"', '"["', "a pattern that is none"),
        ('positionsFile "positions"', 'positionsFile "missing"', "positions that are not there"),
        ('positionsFile "positions"', 'positionsFile "/dev/zero"', "positions from a device"),
        ("type manualInjection", "type manualInjecton", "an injection in another spelling"),
        ("injectionModels", "injectionModel", "no injection"),
        ("type particleTracks", "type particleTrack", "a cloudFunction in another spelling"),
        ("maxSamples 50", "maxSamples -1", "a negative number of samples"),
        (r"\}\s*$", "", "a brace missing at the end"),
        (r"$", "\n}", "a brace too many"),
        ("solution", "solution { ", "a brace too many within"),
    ):  # fmt: skip
        yield (
            what,
            Kind(
                swap(
                    SETTINGS,
                    re.escape(before) if before[0] not in "\\$" else before,
                    after.replace("\\", r"\\"),
                )
            ),
        )
    for name in (
        "..",
        ".",
        "a/b",
        "checkpoint",
        "fates.csv",
        "softCloud.pvd",
        "softCloud_000000.vtp",
        "manifest.json",
    ):
        yield f"a cloudFunction named {name}", Kind(swap(SETTINGS, r"\{ paths", f'{{ "{name}"'))
    yield (
        "a thousand million million particles",
        Kind(
            swap(
                SETTINGS,
                r'type manualInjection; positionsFile "positions"; U0 \(0 0 0\);',
                "type patchInjection; patch lid; parcelsPerSecond 1e15; duration 1; U0 (0 0 0);",
            )
        ),
    )
    # As in OpenFOAM the later one holds.
    yield "an entry twice", Kind(swap(SETTINGS, "rho0 1000;", "rho0 1000; rho0 2000;"), visible=False)
    yield "3000 dictionaries in each other", Kind(add(SETTINGS, "a { " * 3000 + "}" * 3000))
    yield (
        "macros that grow without end",
        Kind(
            add(
                SETTINGS,
                "a0 (1 2 3 4 5 6 7 8);\n" + "".join(f"a{k + 1} ({f'$a{k} ' * 10});\n" for k in range(12)),
            )
        ),
    )
    yield "a string that does not end", Kind(add(SETTINGS, '\nname "abc'))
    yield "a comment that does not end", Kind(add(SETTINGS, "\n/* abc"))
    yield "a word of a million letters", Kind(add(SETTINGS, "\n" + "x" * 1_000_000 + " 1;"))
    yield (
        "letters that are none",
        Kind(add(SETTINGS, "\nx \udcff;".encode("utf-8", "surrogateescape").decode("latin-1"))),
    )


RESULTS = "postProcessing/softCloud/"


def _of_an_earlier_run() -> Iterator[tuple[str, Kind]]:
    yield "a damaged .pvd of an earlier run", Kind(put(RESULTS + "softCloud.pvd", b"<VTKFile><Coll"))
    yield "a .pvd of an earlier run that is a folder", Kind(put(RESULTS + "softCloud.pvd", Odd("folder")))
    yield "a manifest that is none", Kind(put(RESULTS + "manifest.json", b"{ nothing"), words=("-overwrite",))
    yield (
        "a manifest that names files above",
        Kind(
            put(RESULTS + "manifest.json", b'{"files": ["../../constant/g", "/etc/passwd"]}'),
            words=("-overwrite",),
        ),
    )
    yield (
        "a checkpoint that is none",
        Kind(put(RESULTS + "checkpoint/0.001.checkpoint", b"abc"), words=("-resume",)),
    )
    yield (
        "a checkpoint that is empty",
        Kind(put(RESULTS + "checkpoint/0.001.checkpoint", b""), words=("-resume",)),
    )
    yield "nothing to resume", Kind(lambda files: files, words=("-resume",))
    yield "results that are a file", Kind(put("postProcessing", b"x"))


def _plain(files: Files, name: str) -> bytes:
    content = files.get(name, b"")
    return b"" if isinstance(content, Odd) else content


def _turned(text: bytes) -> bytes:
    return re.sub(rb"\n4\((\d+) (\d+) (\d+) (\d+)\)", rb"\n4(\4 \3 \2 \1)", text, count=1)


def _doubled(text: bytes) -> bytes:
    return re.sub(rb"\n4\((\d+) (\d+) (\d+) (\d+)\)", rb"\n4(\1 \1 \3 \4)", text, count=1)


def _exchanged(text: bytes) -> bytes:
    return re.sub(rb"\n(4\([^)]*\))\n(4\([^)]*\))", rb"\n\2\n\1", text, count=1)


Points: TypeAlias = dict[int, tuple[float, ...]]


def _moved(text: bytes, change: Callable[[Points], Points]) -> bytes:
    """Move some points of an ascii list."""
    rows = list(re.finditer(rb"\n\(([-\d][^()]*)\)", text))
    old = {k: tuple(float(v) for v in r[1].split()) for k, r in enumerate(rows)}
    for k, place in sorted(change(old).items(), reverse=True):
        start, end = rows[k].span()
        text = text[:start] + b"\n(" + " ".join(f"{v:.9g}" for v in place).encode() + b")" + text[end:]
    return text


def _flattened(x: Points) -> Points:
    """The upper points of the first cell of two by two by two put onto the lower ones."""
    return {upper: x[upper - 9] for upper in (9, 10, 12, 13)}


def _crossed(x: Points) -> Points:
    """The upper points of the first cell put below it."""
    return {upper: (*x[upper][:2], -0.5) for upper in (9, 10, 12, 13)}


def _shifted(text: bytes) -> bytes:
    """The first list of vectors, moved on by one."""
    begin = text.index(b"\n(\n") + 3
    end = text.index(b"\n)", begin)
    lines = text[begin:end].split(b"\n")
    return text[:begin] + b"\n".join(lines[-1:] + lines[:-1]) + text[end:]


KINDS: dict[str, Kind] = dict(
    [
        *_in_every_file(),
        *_in_lists(),
        *_of_the_flow(),
        *_of_the_mesh(),
        *_of_the_settings(),
        *_of_an_earlier_run(),
    ]
)
