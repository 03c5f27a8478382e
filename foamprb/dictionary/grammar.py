"""OpenFOAM's dictionaries: their grammar, with macros and includes, and where each entry was written."""

from __future__ import annotations

import gzip
import logging
import os
import re
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

from foamprb.dictionary.files import existing, has_both_forms
from foamprb.errors import InputError, suggestion

log = logging.getLogger("foamprb")

DICTIONARY_TEXT = "a dictionary { … }"


@dataclass(frozen=True)
class Source:
    """A file that is read for a case."""

    path: Path
    case: Path

    def __str__(self) -> str:
        path, case = self.path.resolve(), self.case.resolve()
        return str(path.relative_to(case) if path.is_relative_to(case) else self.path)

    def mistake(self, line: int, what: str) -> InputError:
        """Make the error of a line."""
        return InputError(f"{self}, line {line}: {what}")


@dataclass(eq=False)
class Entry:
    """What stands under a key of a dictionary, where it was written, and whether a macro has used it."""

    key: str
    parent: Entry | None
    source: Source
    line: int
    used: bool = field(default=False, kw_only=True)

    @property
    def path(self) -> str:
        """Keys from the top of the file, with slashes between them."""
        above = self.parent.path if self.parent else ""
        return f"{above}/{unquoted(self.key)}" if above else unquoted(self.key)

    def mistake(self, what: str) -> InputError:
        """Make the error of this entry: file, line, path, and what is wrong."""
        return self.source.mistake(self.line, f"{self.path} {what}")

    def missing(self, key: str, allowed: str) -> InputError:
        """Make the error of a key that this dictionary lacks."""
        path = f"{self.path}/{key}" if self.path else key
        place = f", line {self.line}" if self.path else ""
        return InputError(f"{self.source}{place}: {path} is missing. {allowed}")

    def dictionary(self) -> Dictionary:
        """Take this entry as a dictionary; a key without a value, such as ``gravity;``, is an empty one."""
        raise self.mistake(f"is {self}. Allowed: {DICTIONARY_TEXT}.")

    def copy(self, key: str, parent: Entry) -> Entry:
        """Copy to another place."""
        return replace(self, key=key, parent=parent)


@dataclass(eq=False)
class Stream(Entry):
    """An entry's tokens up to the semicolon, macros expanded."""

    tokens: tuple[str, ...] = ()

    def dictionary(self) -> Dictionary:
        """See :meth:`Entry.dictionary`."""
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
    """Entries by key, in their order."""

    entries: dict[str, Entry] = field(default_factory=dict)

    def __str__(self) -> str:
        return "a dictionary"

    def dictionary(self) -> Dictionary:
        """See :meth:`Entry.dictionary`."""
        return self

    def at(self, path: str) -> Entry:
        """Find the entry that the keys of a path with slashes lead to."""
        entry: Entry = self
        for key in path.split("/"):
            entry = entry.dictionary().entries[key]
        return entry

    def copy(self, key: str, parent: Entry) -> Dictionary:
        """Copy to another place, entries and all."""
        twin = replace(self, key=key, parent=parent)
        twin.entries = {name: entry.copy(name, twin) for name, entry in self.entries.items()}
        return twin

    def add(self, entry: Entry) -> None:
        """Add an entry; of two dictionaries with one key the entries are merged, else the last one counts."""
        earlier = self.entries.get(entry.key)
        if isinstance(earlier, Dictionary) and isinstance(entry, Dictionary):
            earlier.merge(entry)
        else:
            self.entries[entry.key] = entry

    def merge(self, other: Dictionary) -> None:
        """Take over another dictionary's entries."""
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
        """Copy to another place, dictionaries and all."""
        twin = replace(self, key=key, parent=parent)
        twin.items = [item.copy(item.key, twin) for item in self.items]
        return twin


def read_dictionary(path: Path, case: Path) -> Dictionary:
    """Read a file in OpenFOAM's dictionary format, with macros and includes.

    Expanded are ``$name`` (also ``${name}``), looked up from the dictionary where it stands outward, with
    ``.`` between the keys of nested dictionaries; ``$:a.b`` from the top of the file; ``$.name`` and
    ``$..name`` in this and in the enclosing dictionary only; ``$name;`` in place of an entry, which merges
    the dictionary ``name``; ``#include``, ``#includeIfPresent``, ``#sinclude`` and ``#includeEtc``. A macro
    sees what is complete before it, as in OpenFOAM: not the dictionary that it stands in.

    Parameters
    ----------
    path
        The file.
    case
        The case, which messages name files relative to, and ``$FOAM_CASE`` and ``<case>`` in an include mean.

    Raises
    ------
    InputError
        If the file cannot be read or is not such a dictionary; with the line.
    """
    source = Source(path, case)
    root = Dictionary("", None, source, 0)
    text = _read_text(path, lambda why: InputError(f"{source}: {why} (case {case})."))
    _Parser(source, text, including=()).fill(root)
    root.entries.pop(_HEADER, None)
    return root


def parse_dictionary(text: str, path: Path, case: Path) -> Dictionary:
    """Make of a text what :func:`read_dictionary` would of the file, which it comes from."""
    root = Dictionary("", None, Source(path, case), 0)
    _Parser(root.source, text, including=()).fill(root)
    root.entries.pop(_HEADER, None)
    return root


def read_dictionary_list(path: Path, case: Path) -> DictionaryList:
    """Read a file that is a list of named dictionaries with their number before it, as ``polyMesh/boundary``.

    Parameters
    ----------
    path
        The file, which may be compressed.
    case
        As in :func:`read_dictionary`.

    Raises
    ------
    InputError
        If the file cannot be read or is not such a list; with the line.
    """
    source = Source(path, case)
    root = Dictionary("", None, source, 0)
    text = _read_text(path, lambda why: InputError(f"{source}: {why} (case {case})."))
    return _Parser(source, text, including=()).counted_list(root)


def _read_text(path: Path, mistake: Callable[[str], InputError]) -> str:
    found = existing(path) or path
    if has_both_forms(path):
        log.warning("%s and %s.gz are both there: the first is read, as by OpenFOAM.", path, path.name)
    try:
        with gzip.open(found) if found.suffix == ".gz" else found.open("rb") as stream:
            return stream.read().decode("utf-8")
    except UnicodeDecodeError as error:
        raise mistake("is not a text file") from error
    except (OSError, EOFError, zlib.error) as error:
        raise mistake(getattr(error, "strerror", None) or str(error) or "cannot be read") from error


class _Token(NamedTuple):
    text: str
    line: int


_TOKEN = re.compile(
    r"""
      (?P<skip> \s+ | //[^\n]* | /\*.*?\*/ )
    | (?P<token> "(?:\\.|[^"\\])*"                          # a string
               | \#\{.*?\#\}                                # code
               | \$\{[^\s{}]*\}
               | [{}()\[\];]
               | (?: [^\s"/;{}()\[\]] | /(?![/*]) )+ )      # a word or number
    """,
    re.DOTALL | re.VERBOSE,
)
_HEADER = "FoamFile"
_CLOSING = {"{": "}", "(": ")", "[": "]"}
_MARKS = frozenset("{}()[];")
_INCLUDES = {"#include": True, "#includeIfPresent": False, "#sinclude": False, "#includeEtc": True}
_ETC = "#includeEtc"
_CASE_FOLDERS = {
    "$FOAM_CASE": "",
    "${FOAM_CASE}": "",
    "<case>": "",
    "<constant>": "constant",
    "<system>": "system",
}


def _tokens(source: Source, text: str) -> Iterator[_Token]:
    position, line = 0, 1
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            what = "comment" if text[position] == "/" else "string"
            raise source.mistake(line, f"this {what} has no end.")
        if match["token"]:
            yield _Token(match["token"], line)
        line += match[0].count("\n")
        position = match.end()
    yield _Token("", line)


class _Parser:
    """Reads one file; ``including`` are the files that it is being included from."""

    def __init__(self, source: Source, text: str, including: tuple[Path, ...]) -> None:
        self.source = source
        self.tokens = list(_tokens(source, text))
        self.position = 0
        self.files = (*including, source.path.resolve())

    def fill(self, dictionary: Dictionary, opened: _Token | None = None) -> None:
        """Read entries into a dictionary, up to its closing brace or the end of the file."""
        while True:
            token = self.take()
            if token.text == ("}" if opened else ""):
                return
            if token.text == "":
                raise self.mistake(opened or token, f"of {dictionary.path} has no closing }}.")
            if token.text == ";":
                continue
            if token.text.startswith("#"):
                self.include(token, dictionary)
            elif token.text.startswith("$"):
                self.merge(token, dictionary)
            elif token.text in _MARKS:
                raise self.mistake(token, "stands where a key is expected.")
            else:
                dictionary.add(self.entry(token, dictionary))

    def entry(self, key: _Token, parent: Dictionary) -> Entry:
        """Read what follows a key."""
        start, _, beyond = (self.peek(ahead).text for ahead in range(3))
        if start == "{":
            return self.dictionary(key, parent)
        if start == "(" and beyond == "{":
            return self.dictionaries(key, parent)
        tokens = self.stream(key)
        if start.startswith("$") and len(tokens) == 1:
            twin = self.look_up(tokens[0], parent).copy(key.text, parent)
            twin.used = False
            return twin
        # The variables of a computed value belong to the computation, which whoever needs the value refuses.
        words = [
            word
            for token in tokens
            for word in ([token.text] if start.startswith("#") else self.expand(token, parent))
        ]
        return Stream(key.text, parent, self.source, key.line, tokens=tuple(words))

    def dictionary(self, key: _Token, parent: Entry) -> Dictionary:
        """Read ``{ … }``."""
        dictionary = Dictionary(key.text, parent, self.source, key.line)
        self.fill(dictionary, opened=self.take())
        return dictionary

    def counted_list(self, root: Dictionary) -> DictionaryList:
        """Read a whole file ``FoamFile { … } 2 ( name { … } name { … } )``."""
        if self.peek().text == _HEADER and self.peek(1).text == "{":
            self.dictionary(self.take(), root)
        count = self.take()
        if not count.text.isascii() or not count.text.isdigit() or self.peek().text != "(":
            raise self.mistake(count, "stands where a number and a list ( name { … } … ) are expected.")
        name = self.source.path.name.removesuffix(".gz")
        entries = self.items(_Token(name, count.line), root)
        if self.peek().text == ";":
            self.take()
        if self.peek().text:
            raise self.mistake(self.peek(), "stands behind the list.")
        if int(count.text) != len(entries.items):
            raise self.mistake(count, f"is not the number of entries of the list, {len(entries.items)}.")
        return entries

    def dictionaries(self, key: _Token, parent: Dictionary) -> DictionaryList:
        """Read ``( name { … } name { … } );``."""
        entry = self.items(key, parent)
        if self.take().text != ";":
            raise self.mistake(key, "has no closing ;.")
        return entry

    def items(self, key: _Token, parent: Dictionary) -> DictionaryList:
        """Read ``( name { … } name { … } )``."""
        entry = DictionaryList(key.text, parent, self.source, key.line)
        self.take()
        while (name := self.take()).text != ")":
            if name.text in _MARKS or name.text == "" or self.peek().text != "{":
                raise self.mistake(
                    name, f"in the list {entry.path} is not a name with its dictionary {{ … }}."
                )
            entry.items.append(self.dictionary(name, entry))
        return entry

    def stream(self, key: _Token) -> list[_Token]:
        """Read tokens up to the semicolon."""
        tokens: list[_Token] = []
        expected: list[str] = []
        computed = self.peek().text.startswith("#")
        while (token := self.take()).text != ";" or expected[-1:] == ["}"]:
            if expected and token.text == expected[-1]:
                expected.pop()
            elif token.text in _CLOSING and (token.text != "{" or computed):
                expected.append(_CLOSING[token.text])
            elif (token.text in _MARKS and token.text != ";") or token.text == "":
                raise self.mistake(key, f"has no closing {expected[-1] if expected else ';'}.")
            tokens.append(token)
        if expected:
            raise self.mistake(key, f"has no closing {expected[-1]}.")
        return tokens

    def expand(self, token: _Token, scope: Dictionary) -> tuple[str, ...]:
        """Replace a macro by the tokens of the entry that it names."""
        if not token.text.startswith("$"):
            return (token.text,)
        entry = self.look_up(token, scope)
        if not isinstance(entry, Stream):
            raise self.mistake(token, f"is {entry}, and cannot stand within a value.")
        return entry.tokens

    def look_up(self, token: _Token, scope: Dictionary) -> Entry:
        """Find the entry that a macro names."""
        name = token.text[1:].removeprefix("{").removesuffix("}")
        scopes = [above for above in _upward(scope) if isinstance(above, Dictionary)]
        dots = len(name) - len(name.lstrip("."))
        if name.startswith(":"):
            scopes = scopes[-1:]
        elif dots:
            scopes = scopes[dots - 1 : dots]
        for dictionary in scopes:
            entry = _descend(dictionary, name.lstrip(".:"))
            if entry is not None:
                for used in _upward(entry):
                    used.used = True
                return entry
        raise self.mistake(token, "is not defined above.")

    def merge(self, token: _Token, dictionary: Dictionary) -> None:
        """Put the entries of the dictionary that a macro names into this one."""
        template = self.look_up(token, dictionary)
        if not isinstance(template, Dictionary):
            raise self.mistake(token, f"stands where a key is expected, but is {template}, not a dictionary.")
        if self.take().text != ";":
            raise self.mistake(token, "has no closing ;.")
        dictionary.merge(template.copy(template.key, dictionary))

    def include(self, directive: _Token, dictionary: Dictionary) -> None:
        """Read another file's entries into a dictionary."""
        if directive.text not in _INCLUDES:
            raise self.mistake(directive, f"is not supported. {suggestion(directive.text, _INCLUDES)}")
        name = self.take()
        if name.text in _MARKS or name.text == "":
            raise self.mistake(directive, "names no file.")
        path = self.source.path.parent / self.in_case(unquoted(name.text))
        if directive.text == _ETC:
            path = self.in_etc(name)
        if not (existing(path) or _INCLUDES[directive.text]):
            return
        if path.resolve() in self.files:
            raise self.mistake(name, "includes itself.")
        text = _read_text(path, lambda why: self.mistake(name, f"cannot be included: {why}."))
        _Parser(Source(path, self.source.case), text, self.files).fill(dictionary)
        dictionary.entries.pop(_HEADER, None)

    def in_case(self, name: str) -> str:
        """Replace a leading tag for a folder of the case."""
        for tag, folder in _CASE_FOLDERS.items():
            if name.startswith(tag):
                return f"{self.source.case.resolve() / folder}{name.removeprefix(tag)}"
        return name

    def in_etc(self, name: _Token) -> Path:
        """Find a file in OpenFOAM's folders ``etc``: the user's, the site's, and that of the installation."""
        etc = [Path.home() / ".OpenFOAM"]
        etc += [
            Path(os.environ[key], "etc")
            for key in ("WM_PROJECT_SITE", "WM_PROJECT_DIR")
            if os.environ.get(key)
        ]
        for folder in etc:
            if existing(folder / unquoted(name.text)):
                return folder / unquoted(name.text)
        raise self.mistake(
            name,
            "is in none of the folders "
            + ", ".join(map(str, etc))
            + "; is WM_PROJECT_DIR set? (OpenFOAM's bashrc sets it)",
        )

    def peek(self, ahead: int = 0) -> _Token:
        """Look at a coming token; the last one has no text."""
        return self.tokens[min(self.position + ahead, len(self.tokens) - 1)]

    def take(self) -> _Token:
        """Go on to the next token."""
        token = self.peek()
        self.position += 1
        return token

    def mistake(self, token: _Token, what: str) -> InputError:
        """Make the error of a token."""
        return self.source.mistake(token.line, f"'{token.text}' {what}")


def _upward(entry: Entry) -> Iterator[Entry]:
    """Go from an entry to the top of the file."""
    above: Entry | None = entry
    while above is not None:
        yield above
        above = above.parent


def _descend(dictionary: Dictionary, name: str) -> Entry | None:
    """Find ``a.b`` or, in a nested dictionary ``a``, ``b``."""
    if name in dictionary.entries:
        return dictionary.entries[name]
    first, _, rest = name.partition(".")
    inner = dictionary.entries.get(first)
    return _descend(inner, rest) if isinstance(inner, Dictionary) and rest else None


def unquoted(text: str) -> str:
    """Strip the quotes of a word, if it has them."""
    return text[1:-1] if text.startswith('"') else text
