"""Documentation of the entries, as ``foamprb help`` prints it.

It is read from ``entries.json``, which ``tools/settings_page`` makes of the declarations, as importing these
takes longer than all else.
"""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

from foamprb.errors import InputError, suggestion

FILE = Path(__file__).with_name("entries.json")
_SHORTEST, _MOST_RELATED = 3, 12
"""Shortest word that is searched for in names and texts, and most lines about related entries."""


class EntryText(NamedTuple):
    """Documentation of one entry; texts are Markdown."""

    section: str
    """Name of the section."""
    dictionary: str
    """Path of the section's dictionary."""
    model: str
    """The ``type`` that has the entry; empty if all have it."""
    name: str
    """Path below the dictionary of the section: ``integrationSchemes/shape``."""
    unit: str
    default: str
    allowed: str
    """Allowed values, in the words of a message."""
    meaning: str
    why_idle: str = ""
    """Why it has no effect; empty if it has one."""
    values: Mapping[str, str] = {}
    """What each of its words means; empty if it takes no words."""

    @property
    def full_name(self) -> str:
        """From the top of the file."""
        return "/".join(filter(None, (self.dictionary, self.name)))

    @property
    def path(self) -> str:
        """From the top of the file, with the type in parentheses."""
        return f"{self.full_name} ({self.model})" if self.model else self.full_name


class SectionText(NamedTuple):
    """Documentation of a section."""

    path: str
    models: Mapping[str, str]
    """What each ``type`` is."""


class Texts(NamedTuple):
    """Documentation of all entries, in the order of the page."""

    sections: Mapping[str, SectionText]
    forces: Mapping[str, str]
    """What each of the ``particleForces`` is."""
    entries: Sequence[EntryText]

    def of(self, section: str, model: str | None = None) -> list[EntryText]:
        """Return the entries of a section, or of one ``type`` in it."""
        return [t for t in self.entries if t.section == section and model in (None, t.model)]

    def to_json(self) -> str:
        """Return the text of the file, with a line for each entry."""
        lines = [json.dumps(part, ensure_ascii=False) for part in (self.sections, self.forces, *self.entries)]
        return "[\n" + ",\n".join(lines) + "\n]\n"


@cache
def _texts() -> Texts:
    sections, forces, *entries = json.loads(FILE.read_text(encoding="utf-8"))
    named = {name: SectionText(*section) for name, section in sections.items()}
    return Texts(named, forces, [EntryText(*entry) for entry in entries])


def meaning(section: str, entry: str, model: str = "") -> EntryText:
    """Return the documentation of one entry; raise KeyError if it is not declared."""
    for text in _texts().of(section, model):
        if text.name == entry:
            return text
    raise KeyError(f"{section}: {entry} {model}")


def explain(word: str | None) -> list[str]:
    """Return the documentation of an entry, a dictionary, a type or a value; without a word, a list of all.

    Of an unknown name it is a list of entries that have the word in their names or texts.

    Raises
    ------
    InputError
        If there are none; with the most similar name.
    """
    if word is None:
        return _overview()
    wanted, (sections, forces, everything) = word.strip("/"), _texts()
    lines: list[str] = []
    for text in everything:
        if wanted == text.full_name or text.full_name.endswith(f"/{wanted}"):
            lines += _entry_lines(text)
    for name, section in sections.items():
        if wanted in section.models:
            lines += _model_lines(name, wanted)
        if wanted in (name, section.path):
            lines += _section_lines(name)
    for text in everything:
        if wanted in text.values:
            lines += _value_lines(text, wanted)
    if wanted in forces:
        path = f"particleForces/{wanted}/"
        inner = [t._replace(name=t.name.removeprefix(path)) for t in everything if t.name.startswith(path)]
        title = [f"subModels/particleForces/{wanted}", *_wrapped(plain(forces[wanted]))]
        lines += [*title, *_list_lines(inner), ""]
    if not lines:
        # A dictionary without a section, such as integrationSchemes.
        within = [text for text in everything if f"/{wanted}/" in f"/{text.path}"]
        lines = [line for text in within for line in _entry_lines(text)]
    if lines:
        return lines[:-1]
    if related := _related(wanted):
        return [f"No entry is named '{word}'. Related ones; foamprb help NAME has details:", *related]
    paths = [text.full_name for text in everything if not text.why_idle]
    names = {part for path in paths for part in path.split("/") if not part.startswith("(")}
    names |= {value for text in everything for value in text.values}
    names |= {model for section in sections.values() for model in section.models} | {*sections, *forces}
    close = suggestion(word, names)
    question = close.partition(" Allowed:")[0] if close.startswith("Did") else "foamprb help lists all names."
    raise InputError(f"no entry, dictionary, type or value '{word}'. {question}")


def _related(word: str) -> list[str]:
    """Return lines about entries, types and values whose name contains a word, or whose text has it."""
    if len(word) < _SHORTEST:
        return []
    in_text = re.compile(rf"\b{re.escape(word)}s?\b", re.IGNORECASE)
    named, described = {}, {}
    for text in _texts().entries:
        if text.why_idle:
            continue
        if word.lower() in text.name.rpartition("/")[2].lower():
            named[text.path] = text.meaning
        elif in_text.search(plain(text.meaning)):
            described[text.path] = text.meaning
        named |= {f"{text.full_name} {value}": s for value, s in text.values.items() if in_text.search(s)}
    for section in _texts().sections.values():
        models = section.models.items()
        named |= {f"{section.path}: type {model}": s for model, s in models if in_text.search(plain(s))}
    lines = [f"    {name}: {plain(said)}" for name, said in (named or described).items()]
    more = [f"    … and {len(lines) - _MOST_RELATED} more"] if len(lines) > _MOST_RELATED else []
    return [*lines[:_MOST_RELATED], *more]


def _overview() -> list[str]:
    lines = [
        "Entries of constant/softCloudProperties. Details of an entry, dictionary or type: foamprb help NAME"
    ]
    for name, section in _texts().sections.items():
        words = [*section.models] or [t.name for t in _texts().of(name) if not t.why_idle]
        if name == "particleForces":
            words = ["ellipsoidDrag", *_texts().forces]
        lines += ["", f"{name}{'  (types)' if section.models else ''}", *_wrapped(", ".join(words))]
    return lines


def _entry_lines(text: EntryText) -> list[str]:
    facts = [("unit", text.unit), ("default", text.default), ("allowed", text.allowed)]
    shown = [f"    {name:8s} {plain(value)}" for name, value in facts if value]
    said = f"{text.meaning}: {text.why_idle}" if text.why_idle else text.meaning
    return [text.path, *_wrapped(plain(said)), *shown, ""]


def _model_lines(name: str, model: str) -> list[str]:
    section = _texts().sections[name]
    lines = [f"{section.path}: type {model}", *_wrapped(plain(section.models[model]))]
    return [*lines, *_list_lines(_texts().of(name, model)), ""]


def _value_lines(text: EntryText, value: str) -> list[str]:
    """Return what a word of an entry means, with the entries of the dictionary that belong to it."""
    of_value = [
        other
        for other in _texts().entries
        if other.dictionary == text.dictionary
        and other.name != text.name
        and (other.name.startswith(f"{value}Coeffs/") or f"`{value}`" in f"{other.default} {other.meaning}")
    ]
    said = text.values[value] or text.meaning
    title = f"{text.full_name} {value}{f' ({text.model})' if text.model else ''}"
    return [title, *_wrapped(plain(said)), *_list_lines(of_value), ""]


def _section_lines(name: str) -> list[str]:
    section = _texts().sections[name]
    lines = [section.path or "constant/softCloudProperties"]
    if section.models:
        return [
            *lines,
            *(f"    {model:24s} {plain(text)}" for model, text in section.models.items()),
            "",
        ]
    return [*lines, *_list_lines(_texts().of(name)), ""]


def _list_lines(texts: Sequence[EntryText]) -> list[str]:
    lines = []
    for text in texts:
        if not text.why_idle:
            unit = f", {text.unit}" if text.unit else ""
            default = f" [{plain(text.default)}]" if text.default else ""
            lines.append(f"    {text.name:24s} {plain(text.meaning)}{unit}{default}")
    return lines


def plain(markdown: str) -> str:
    """Return Markdown as plain text."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "")


def _wrapped(text: str) -> list[str]:
    indent = "    "
    return textwrap.wrap(text, 105, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False)
