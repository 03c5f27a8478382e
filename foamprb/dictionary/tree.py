"""Dictionaries as trees of entries, each with the file and line of its definition."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from foamprb.dictionary.mistakes import Mistake

DICTIONARY_TEXT = "a dictionary { … }"
"""Name of a dictionary in messages."""


def real(path: Path) -> Path:
    """Return the target of a path; of a link to itself, the part that can be followed."""
    return Path(os.path.realpath(path))


@dataclass(frozen=True)
class CaseFile:
    """A file of a case."""

    path: Path
    case: Path

    def __str__(self) -> str:
        path, case = real(self.path), real(self.case)
        return str(path.relative_to(case) if path.is_relative_to(case) else self.path)

    def mistake(self, line: int, what: str, *, missing: str = "", meant: Iterable[str] = ()) -> Mistake:
        """Return the error for a line of the file, or for the whole file if the line is 0."""
        return Mistake(str(self), line, what, missing=missing, meant=meant)


@dataclass(eq=False)
class Entry:
    """Value under a key of a dictionary, with its place, and whether a macro has used it."""

    key: str
    parent: Entry | None
    source: CaseFile
    line: int
    used: bool = field(default=False, kw_only=True)

    @property
    def path(self) -> str:
        """Keys from the top of the file, with slashes between them."""
        above = self.parent.path if self.parent else ""
        return f"{above}/{unquoted(self.key)}" if above else unquoted(self.key)

    def mistake(self, what: str, meant: Iterable[str] = ()) -> Mistake:
        """Return the error for this entry: file, line, path, and the mistake.

        Parameters
        ----------
        what
            Message after the path.
        meant
            Names of similar entries in the same dictionary.
        """
        beside = f"{self.parent.path}/" if self.parent and self.parent.path else ""
        paths = [beside + name for name in meant]
        return self.source.mistake(self.line, f"{self.path} {what}".lstrip(), meant=paths)

    def missing(self, key: str, allowed: str) -> Mistake:
        """Return the error for a missing key of this dictionary."""
        path = f"{self.path}/{key}" if self.path else key
        return self.source.mistake(self.line, f"{path} is missing. {allowed}", missing=path)

    def dictionary(self) -> Dictionary:
        """Return this entry as a dictionary; a key without a value, such as ``gravity;``, is an empty one."""
        raise self.mistake(f"is {self}. Allowed: {DICTIONARY_TEXT}.")

    def copy(self, key: str, parent: Entry) -> Entry:
        """Return a copy for another place of the tree."""
        return replace(self, key=key, parent=parent)


@dataclass(eq=False)
class Stream(Entry):
    """An entry with a value: its tokens up to the semicolon, macros expanded."""

    tokens: tuple[str, ...] = ()

    def dictionary(self) -> Dictionary:
        """Return an empty dictionary if there are no tokens; see :meth:`Entry.dictionary`."""
        if self.tokens:
            return super().dictionary()
        return Dictionary(self.key, self.parent, self.source, self.line)

    @property
    def text(self) -> str:
        """The tokens with a space between any two."""
        return " ".join(self.tokens)

    def __str__(self) -> str:
        text = re.sub(r"(?<=[(\[]) | (?=[)\]])", "", self.text)
        return f"'{text if len(text) <= 60 else text[:57] + '...'}'"


@dataclass(eq=False)
class Dictionary(Entry):
    """Entries by key, in the order of the file."""

    entries: dict[str, Entry] = field(default_factory=dict)

    def __str__(self) -> str:
        return "a dictionary"

    def dictionary(self) -> Dictionary:
        """Return this dictionary; see :meth:`Entry.dictionary`."""
        return self

    def at(self, path: str) -> Entry:
        """Return the entry at a path with slashes; raise KeyError if there is none."""
        entry: Entry = self
        for key in path.split("/"):
            entry = entry.dictionary().entries[key]
        return entry

    def copy(self, key: str, parent: Entry) -> Dictionary:
        """Return a deep copy for another place of the tree."""
        twin = replace(self, key=key, parent=parent)
        twin.entries = {name: entry.copy(name, twin) for name, entry in self.entries.items()}
        return twin

    def add(self, entry: Entry) -> None:
        """Add an entry: merge two dictionaries with the same key, else replace the earlier entry."""
        earlier = self.entries.get(entry.key)
        if isinstance(earlier, Dictionary) and isinstance(entry, Dictionary):
            earlier.merge(entry)
        else:
            self.entries[entry.key] = entry

    def merge(self, other: Dictionary) -> None:
        """Add the entries of another dictionary."""
        for entry in other.entries.values():
            entry.parent = self
            self.add(entry)


@dataclass(eq=False)
class DictionaryList(Entry):
    """Named dictionaries in parentheses, ``( name { … } name { … } )``; a name may occur twice."""

    items: list[Dictionary] = field(default_factory=list)

    def __str__(self) -> str:
        return "a list of dictionaries"

    def copy(self, key: str, parent: Entry) -> DictionaryList:
        """Return a deep copy for another place of the tree."""
        twin = replace(self, key=key, parent=parent)
        twin.items = [item.copy(item.key, twin) for item in self.items]
        return twin


def unquoted(text: str) -> str:
    """Return a word without its quotes."""
    return text[1:-1] if text.startswith('"') else text
