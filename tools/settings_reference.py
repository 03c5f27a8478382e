"""Documentation of the entries, from the declarations that read them.

``tools/settings_page`` makes of it the tables of ``docs/settings.md`` and the file of
:mod:`foamprb.settings.help`. A test reports entries that are declared without a
:class:`~foamprb.dictionary.constraints.Meaning`.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, NamedTuple

from foamprb.cloud.forces import FORCES
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution
from foamprb.cloud.injection.models import INJECTIONS
from foamprb.cloud.injection.shapes import SHAPES
from foamprb.cloud.patches import INTERACTIONS
from foamprb.cloud.surroundings.dispersion import DISPERSIONS
from foamprb.cloud.surroundings.registry import SURROUNDINGS
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.dictionary.constraints import Choice, Meaning, NoEffect, Only
from foamprb.dictionary.schema import Schema, allowed, hints_of, members, note_of, rule_of
from foamprb.dictionary.values import READERS
from foamprb.errors import InputError
from foamprb.settings import patches
from foamprb.settings.fluid import ConstantProperties
from foamprb.settings.help import EntryText, SectionText, Texts
from foamprb.settings.injections import InjectionModel, Solid, parameters
from foamprb.settings.settings import CloudProperties, ParticleForces, SubModels
from foamprb.settings.solution import Solution

__all__ = ["SECTIONS", "Section", "entries_of", "tables", "texts", "with_tables"]


class Section(NamedTuple):
    """A table of the page: its dictionary, and the schemas of its entries."""

    path: str
    schemas: Mapping[str, type[Schema]] = {}
    """By the name of the dictionary within that of the section; ``""`` for its own."""
    models: Mapping[str, type[Schema]] = {}
    """By the word that ``type`` selects."""


_CHOSEN: dict[str, type[Schema]] = {**FORCES, **SURROUNDINGS}

SECTIONS: dict[str, Section] = {
    "file": Section("", {"": CloudProperties}),
    "solution": Section("solution", {"": Solution}),
    "constantProperties": Section("constantProperties", {"": ConstantProperties}),
    "solid": Section("constantProperties/solid", {"": Solid}),
    "shape": Section("constantProperties/shape", models=SHAPES),
    "distributions": Section("(distribution)", models=DISTRIBUTIONS),
    "subModels": Section("subModels", {"": SubModels}),
    "dispersion": Section("subModels", {f"{name}Coeffs": model for name, model in DISPERSIONS.items()}),
    "particleForces": Section(
        "subModels",
        {"particleForces": ParticleForces, **{f"particleForces/{k}": v for k, v in _CHOSEN.items()}},
    ),
    "injectionModels": Section("subModels/injectionModels/(name)", {"": InjectionModel}),
    "injections": Section("subModels/injectionModels/(name)", models=INJECTIONS),
    "patchInteraction": Section(
        "subModels",
        {
            "localInteractionCoeffs": patches.LocalInteraction,
            "standardWallInteractionCoeffs": patches.StandardWallInteraction,
            "reboundCoeffs": patches.ReboundFromAll,
            "(any)Coeffs": patches.AnyInteraction,
        },
    ),
    "interactions": Section("subModels/localInteractionCoeffs/patches/(pattern)", models=INTERACTIONS),
    "cloudFunctions": Section("cloudFunctions/(name)", models=FUNCTIONS),
}
"""The tables of the page, by the names of their marks; ``noEffect`` is a table of all."""


# ---------------------------------------------------------------------------------------------------------
# Declarations


def entries_of(name: str) -> tuple[EntryText, ...]:
    """Return the documentation of the entries of a section, including entries without effect."""
    section = SECTIONS[name]
    texts = [
        text for prefix, schema in section.schemas.items() for text in _described(name, "", prefix, schema)
    ]
    if name == "solid":
        texts += [_text(name, "", key, hint, MISSING) for key, hint in parameters().items()]
    for model, schema in section.models.items():
        texts += _described(name, model, "", schema)
    return tuple(texts)


def _described(section: str, model: str, prefix: str, schema: Any) -> Iterator[EntryText]:
    hints = hints_of(schema)
    for field in fields(schema):
        hint, name = hints[field.name], "/".join(filter(None, (prefix, field.name)))
        schemas = [part for part in members(hint) if is_dataclass(part) and part not in READERS]
        if not schemas or note_of(hint, Meaning):
            yield _text(section, model, name, hint, field.default)
        for inner in schemas:
            if not hasattr(inner, "from_dictionary"):
                yield from _described(section, model, name, inner)


def _text(section: str, model: str, name: str, hint: Any, default: Any) -> EntryText:
    note, rule = note_of(hint, Meaning), rule_of(hint)
    if isinstance(rule, NoEffect):
        return EntryText(section, SECTIONS[section].path, model, name, "", "", "any", "no effect", rule.why)
    unit, said = (note.unit, note.text) if note else ("", "")
    may_be = allowed(hint).removeprefix("Allowed: ").removesuffix(".")
    if isinstance(rule, Only):
        value = (
            str(rule.value).lower() if isinstance(rule.value, bool) else f"{rule.value}".removesuffix(".0")
        )
        said = f"accepted as `{value}` only: {rule.why}"
    elif isinstance(rule, Choice) and sorted(rule.names) != sorted(re.findall(r"`(\w+)`", said)):
        said = f"{said}: {', '.join(f'`{choice}`' for choice in rule.names)}".removeprefix(": ")
    if Distribution in members(hint)[1:]:
        said += "; a number or a [distribution](#distributions)"
    shown = note.default if note and note.default else _shown(default)
    values = _values(hint, note)
    return EntryText(section, SECTIONS[section].path, model, name, unit, shown, may_be, said, "", values)


def _values(hint: Any, note: Meaning | None) -> dict[str, str]:
    """Return the allowed words of an entry, with what each means; of a registry of types, its tables do."""
    rule = rule_of(hint)
    if not isinstance(rule, Choice) or set(rule.names) <= {
        name for s in SECTIONS.values() for name in s.models
    }:
        return {}
    meanings = note.values if note else {}
    return {name: meanings.get(name, "") for name in rule.names}


def _shown(default: Any) -> str:
    """Return a default as the page shows it."""
    match default:
        case bool():
            return f"`{str(default).lower()}`"
        case float() | int():
            return f"{default:g}"
        case str():
            return f"`{default}`" if default else ""
        case tuple():
            return f"`({' '.join(f'{x:g}' if isinstance(x, float) else str(x) for x in default)})`"
    return "required" if default is MISSING else ""


def texts() -> Texts:
    """Return the documentation of all entries."""
    sections = {
        name: SectionText(section.path, {model: summary(schema) for model, schema in section.models.items()})
        for name, section in SECTIONS.items()
    }
    forces = {name: summary(force) for name, force in _CHOSEN.items()}
    return Texts(sections, forces, [text for name in SECTIONS for text in entries_of(name)])


def summary(schema: type) -> str:
    """Return the first paragraph of a schema's docstring, as Markdown."""
    text = inspect.cleandoc(schema.__doc__ or "").split("\n\n")[0]
    return " ".join(text.replace("``", "`").split())


# ---------------------------------------------------------------------------------------------------------
# The page


def tables() -> dict[str, str]:
    """Return the tables of ``docs/settings.md``, in Markdown, by the names of their marks."""
    made = {name: _models_table(name) if SECTIONS[name].models else _table(name) for name in SECTIONS}
    return made | {"noEffect": _idle_table()}


def with_tables(page: str) -> str:
    """Return a page with new tables between its marks ``<!-- table NAME -->`` and ``<!-- end -->``.

    Raises
    ------
    InputError
        If the marks of the page are not the names of the tables.
    """
    made = tables()
    marked = re.findall(r"<!-- table (\w+) -->", page)
    if sorted(marked) != sorted(made):
        raise InputError(f"the page has the tables {sorted(marked)}, not {sorted(made)}.")
    return re.sub(
        r"(<!-- table (\w+) -->\n).*?(<!-- end -->)",
        lambda mark: f"{mark[1]}{made[mark[2]]}{mark[3]}",
        page,
        flags=re.DOTALL,
    )


def _row(*cells: str) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |\n".replace("|  |", "| |")


def _head(*cells: str) -> str:
    return _row(*cells) + "|---" * len(cells) + "|\n"


def _table(name: str) -> str:
    shown = [text for text in entries_of(name) if not text.why_idle]
    rows = [_row(f"`{t.name}`", t.unit, t.default, t.meaning) for t in shown]
    if name == "particleForces":
        names = {text.name for text in shown}
        rows += [
            _row(f"`particleForces/{force}`", "", "absent", summary(kind))
            for force, kind in _CHOSEN.items()
            if f"particleForces/{force}" not in names
        ]
        rows.sort(key=lambda row: row.split("`")[1])
    return _head("entry", "unit", "default", "meaning") + "".join(rows)


def _models_table(name: str) -> str:
    rows = []
    for model, schema in SECTIONS[name].models.items():
        rows.append(_row(f"`{model}`", "", "", "", summary(schema)))
        texts = (text for text in entries_of(name) if text.model == model and not text.why_idle)
        rows += [_row("", f"`{t.name}`", t.unit, t.default, t.meaning) for t in texts]
    return _head("`type`", "entry", "unit", "default", "meaning") + "".join(rows)


def _idle_table() -> str:
    rows = [
        _row(f"`{text.path}`", text.why_idle)
        for name in SECTIONS
        for text in entries_of(name)
        if text.why_idle
    ]
    return _head("entry", "why") + "".join(rows)
