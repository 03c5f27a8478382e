"""Parser of OpenFOAM's dictionary files, with macros and includes, to trees of entries."""

from __future__ import annotations

import gzip
import logging
import os
import re
import zlib
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from foamprb.dictionary.files import existing
from foamprb.dictionary.mistakes import Mistake
from foamprb.dictionary.patterns import matches
from foamprb.dictionary.tree import CaseFile, Dictionary, DictionaryList, Entry, Stream, real, unquoted
from foamprb.errors import InputError, suggestion

log = logging.getLogger("foamprb")


def read_dictionary(path: Path, case: Path, warn: bool = False) -> Dictionary:
    """Read a file in OpenFOAM's dictionary format, with macros and includes.

    These macros and directives are expanded:

    * ``$name`` and ``${name}``, sought in the dictionary where it stands, then in those around it; with ``.``
      between the keys of nested dictionaries;
    * ``$:a.b``, sought from the top of the file; ``$.name`` and ``$..name``, sought in this dictionary and in
      the enclosing one only;
    * ``${:$name}``, whose name has the value of another macro or of a variable of the environment;
    * ``$name;`` in place of an entry, which merges the dictionary ``name``, by its key or by a pattern;
    * ``#include``, ``#includeIfPresent``, ``#sinclude`` and ``#includeEtc``.

    As in OpenFOAM, a macro can name entries that are complete before it; its own dictionary is not.

    Parameters
    ----------
    path
        The file.
    case
        The case: messages name files relative to it, and ``$FOAM_CASE`` and ``<case>`` in an include mean it.
    warn
        Whether to warn of entries that stand twice in a dictionary, in one file.
    """
    source, spent = CaseFile(path, case), _Spent()
    root = Dictionary("", None, source, 0)
    text = _read_text(path, spent, lambda why: InputError(f"{source}: {why} (case {case})."))
    _Parser(source, text, (), spent).fill(root)
    for repeated in spent.repeated if warn else ():
        log.warning("%s", repeated)
    root.entries.pop(_HEADER, None)
    return root


def parse_dictionary(text: str, path: Path, case: Path) -> Dictionary:
    """Parse the text of a file; see :func:`read_dictionary`."""
    root = Dictionary("", None, CaseFile(path, case), 0)
    _Parser(root.source, text, (), _Spent()).fill(root)
    root.entries.pop(_HEADER, None)
    return root


def read_dictionary_list(path: Path, case: Path, text: str | None = None) -> DictionaryList:
    """Read a file with a list of named dictionaries and their number, such as ``polyMesh/boundary``.

    Parameters
    ----------
    path
        The file, which may be compressed.
    case
        See :func:`read_dictionary`.
    text
        Contents of the file, if they have been read.
    """
    source, spent = CaseFile(path, case), _Spent()
    root = Dictionary("", None, source, 0)
    if text is None:
        text = _read_text(path, spent, lambda why: InputError(f"{source}: {why} (case {case})."))
    return _Parser(source, text, (), spent).counted_list(root)


MOST_BYTES = 8 << 20
"""Largest size of a dictionary with its included files, decompressed."""
MOST_FILES = 1000
"""Largest number of files that a dictionary includes, nested or not."""
MOST_NESTED = 100
"""Largest depth of nested dictionaries."""
MOST_WORDS = 200_000
"""Largest number of words to which the macros of a dictionary expand."""


@dataclass
class _Spent:
    """Present use of these limits by a dictionary, with its included files."""

    bytes: int = 0
    files: int = 0
    words: int = 0
    repeated: list[Mistake] = field(default_factory=list)
    """Entries that stand twice in a dictionary."""


def _read_text(path: Path, spent: _Spent, mistake: Callable[[str], InputError]) -> str:
    file = existing(path) or path
    try:
        # Reading a pipe or a device may never end.
        if file.exists() and not file.is_file():
            raise mistake("is not a file")
        with gzip.open(file) if file.suffix == ".gz" else file.open("rb") as stream:
            data = stream.read(MOST_BYTES - spent.bytes + 1)
            spent.bytes += len(data)
            # Editors of Windows begin a text with a byte order mark.
            text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise mistake("is not a text file") from error
    except (OSError, EOFError, ValueError, zlib.error) as error:
        raise mistake(getattr(error, "strerror", None) or str(error) or "cannot be read") from error
    if spent.bytes > MOST_BYTES:
        raise mistake(f"has more than {MOST_BYTES >> 20} MiB, too large for a dictionary")
    return text


class _Token(NamedTuple):
    text: str
    line: int


_TOKEN = re.compile(
    r"""
      (?P<skip> \s+ | //[^\n]* | /\*.*?\*/ )
    | (?P<token> "(?:\\.|[^"\\])*"                          # a string
               | \#\{.*?\#\}                                # code
               | \$\{(?:[^\s{}]|\$\{[^\s{}]*\})*\}
               | [{}()\[\];]                                 # below: out(2)
               | [A-Za-z_][^\s"/;{}()\[\]]* (?: \( [^\s"/;{}()\[\]]* \) [^\s"/;{}()\[\]]* )+ (?=[\s;])
               | (?: [^\s"/;{}()\[\]] | /(?![/*]) )+ )      # a word or number
    """,
    re.DOTALL | re.VERBOSE,
)
_HEADER = "FoamFile"
_INNER = re.compile(r"\$(?:\{([^\s{}]*)\}|([\w.:]+))")
"""Macro in the name of another one."""
_COUNT = re.compile(r"\d{1,18}", re.ASCII)
_CLOSING = {"{": "}", "(": ")", "[": "]"}
_MARKS = frozenset("{}()[];")
_INCLUDES = {"#include": True, "#includeIfPresent": False, "#sinclude": False, "#includeEtc": True}
_ETC = "#includeEtc"
_FUNCTION = "#includeFunc"
_CASE_FOLDERS = {
    "$FOAM_CASE": "",
    "${FOAM_CASE}": "",
    "<case>": "",
    "<constant>": "constant",
    "<system>": "system",
}
_HOME = ("$HOME", "${HOME}", "~")


def _tokens(source: CaseFile, text: str) -> Iterator[_Token]:
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
    """Parser of one file; ``including`` are the files that include it."""

    def __init__(self, source: CaseFile, text: str, including: tuple[Path, ...], spent: _Spent) -> None:
        self.source = source
        self.spent = spent
        self.tokens = list(_tokens(source, text))
        self.position = 0
        self.files = (*including, real(source.path))

    def fill(self, dictionary: Dictionary, opened: _Token | None = None) -> None:
        """Read entries into a dictionary, up to its closing brace or the end of the file."""
        lines: dict[str, int] = {}
        while True:
            token = self.take()
            if token.text == ("}" if opened else ""):
                return
            if token.text == "":
                raise self.mistake(opened or token, f"of {dictionary.path} has no closing }}.")
            if token.text == ";":
                continue
            if token.text == _FUNCTION:
                dictionary.add(self.function(token, dictionary))
            elif token.text.startswith("#"):
                self.include(token, dictionary)
            elif token.text.startswith("$"):
                self.merge(token, dictionary)
            elif token.text in _MARKS:
                raise self.mistake(token, "stands where a key is expected.")
            else:
                entry = self.entry(token, dictionary)
                if entry.key in lines:
                    how = "both are merged" if isinstance(entry, Dictionary) else "the last one counts"
                    what = f"stands in line {lines[entry.key]} too: {how}."
                    self.spent.repeated.append(entry.mistake(what))
                lines[entry.key] = entry.line
                dictionary.add(entry)

    def entry(self, key: _Token, parent: Dictionary) -> Entry:
        """Read the value after a key."""
        start, _, beyond = (self.peek(ahead).text for ahead in range(3))
        if start == "{":
            return self.dictionary(key, parent)
        if start == "(" and beyond == "{":
            return self.dictionaries(key, parent)
        tokens = self.stream(key)
        if start.startswith("$") and len(tokens) == 1:
            twin = self.copy(tokens[0], self.look_up(tokens[0], parent), key.text, parent)
            twin.used = False
            return twin
        # A computed value keeps its variables: reading it is an error.
        words = [
            word
            for token in tokens
            for word in ([token.text] if start.startswith("#") else self.expand(token, parent))
        ]
        return Stream(key.text, parent, self.source, key.line, tokens=tuple(words))

    def dictionary(self, key: _Token, parent: Entry) -> Dictionary:
        """Read ``{ … }``."""
        dictionary = Dictionary(key.text, parent, self.source, key.line)
        self.require_depth(key, _depth(dictionary))
        self.fill(dictionary, opened=self.take())
        return dictionary

    def counted_list(self, root: Dictionary) -> DictionaryList:
        """Read a whole file ``FoamFile { … } 2 ( name { … } name { … } )``."""
        if self.peek().text == _HEADER and self.peek(1).text == "{":
            self.dictionary(self.take(), root)
        count = self.take()
        if not _COUNT.fullmatch(count.text) or self.peek().text != "(":
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
        """Read tokens up to the semicolon; dictionaries may stand in lists, ``((air in water) { … })``.

        One may also end a value, ``Gauss multivariateSelection { … };``.
        """
        tokens: list[_Token] = []
        expected: list[str] = []
        computed = self.peek().text.startswith("#")
        while (token := self.take()).text != ";" or expected[-1:] == ["}"]:
            if expected and token.text == expected[-1]:
                expected.pop()
                if token.text == "}" and not expected and not computed and self.peek().text != ";":
                    raise self.mistake(key, "has no closing ;.")
            elif token.text in _CLOSING:
                expected.append(_CLOSING[token.text])
            elif (token.text in _MARKS and token.text != ";") or token.text == "":
                raise self.mistake(key, f"has no closing {expected[-1] if expected else ';'}.")
            tokens.append(token)
        if expected:
            raise self.mistake(key, f"has no closing {expected[-1]}.")
        return tokens

    def expand(self, token: _Token, scope: Dictionary) -> tuple[str, ...]:
        """Replace a macro by the tokens of its entry."""
        if not token.text.startswith("$"):
            return (token.text,)
        entry = self.look_up(token, scope)
        if not isinstance(entry, Stream):
            raise self.mistake(token, f"is {entry}, and cannot stand within a value.")
        self.spend(token, len(entry.tokens))
        return entry.tokens

    def copy(self, token: _Token, entry: Entry, key: str, parent: Entry) -> Entry:
        """Copy the entry of a macro to another place."""
        size, height = _extent(entry)
        self.spend(token, size)
        self.require_depth(token, _depth(parent) + height)
        return entry.copy(key, parent)

    def spend(self, token: _Token, words: int) -> None:
        """Count the words to which a macro expands: without a limit, n lines could expand to 2ⁿ."""
        self.spent.words += words
        if self.spent.words > MOST_WORDS:
            raise self.mistake(
                token, f"expands too far: all macros together to more than {MOST_WORDS} words."
            )

    def require_depth(self, token: _Token, depth: int) -> None:
        """Raise InputError if dictionaries are nested too deeply."""
        if depth > MOST_NESTED:
            raise self.mistake(token, f"is nested too deeply: more than {MOST_NESTED} dictionaries.")

    def look_up(self, token: _Token, scope: Dictionary) -> Entry:
        """Find the entry of a macro."""
        name = token.text[1:].removeprefix("{").removesuffix("}")
        name = _INNER.sub(lambda inner: self.inner(token, inner[1] or inner[2], scope), name)
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
        if "/" in name or "!" in name or ":-" in name or ":+" in name:
            raise self.mistake(
                token, "is a macro of OpenFOAM that is not supported. Allowed: $name, ${name}, $a.b, $:a.b."
            )
        raise self.mistake(token, "is not defined above.")

    def inner(self, token: _Token, name: str, scope: Dictionary) -> str:
        """Return the word of a macro in the name of another one."""
        try:
            words = self.expand(token._replace(text=f"${name}"), scope)
        except InputError:
            words = (os.environ.get(name, ""),)
        if len(words) != 1 or not words[0]:
            raise self.mistake(token, f"has a name with '${name}', which is no word above.")
        return words[0]

    def merge(self, token: _Token, dictionary: Dictionary) -> None:
        """Merge the dictionary of a macro into this one."""
        template = self.look_up(token, dictionary)
        if not isinstance(template, Dictionary):
            raise self.mistake(token, f"stands where a key is expected, but is {template}, not a dictionary.")
        dictionary.merge(self.copy(token, template, template.key, dictionary).dictionary())

    def function(self, directive: _Token, parent: Dictionary) -> Stream:
        """Read ``#includeFunc`` and the rest of its line, an entry that only OpenFOAM's solvers use."""
        words = []
        while self.peek().text not in ("", "}") and self.peek().line == directive.line:
            words.append(self.take().text)
        return Stream(directive.text, parent, self.source, directive.line, tokens=tuple(words))

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
        if not (_INCLUDES[directive.text] or existing(path)):
            return
        self.spent.files += 1
        if self.spent.files > MOST_FILES:
            raise self.mistake(name, f"exceeds the limit of {MOST_FILES} included files.")
        text = _read_text(path, self.spent, lambda why: self.mistake(name, f"cannot be included: {why}."))
        if real(path) in self.files:
            raise self.mistake(name, "includes itself.")
        if len(self.files) > MOST_NESTED:
            raise self.mistake(name, f"is included too deeply: more than {MOST_NESTED} levels.")
        _Parser(CaseFile(path, self.source.case), text, self.files, self.spent).fill(dictionary)
        dictionary.entries.pop(_HEADER, None)

    def in_case(self, name: str) -> str:
        """Replace a tag at the beginning by a folder of the case, or the user's."""
        for tag, folder in _CASE_FOLDERS.items():
            if name.startswith(tag):
                return f"{real(self.source.case) / folder}{name.removeprefix(tag)}"
        for tag in _HOME:
            if name.startswith(f"{tag}/"):
                return f"{Path.home()}{name.removeprefix(tag)}"
        return name

    def in_etc(self, name: _Token) -> Path:
        """Find a file in OpenFOAM's folders ``etc``: the user's, the site's, and the installation's."""
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
        """Return a later token; the last one has no text."""
        return self.tokens[min(self.position + ahead, len(self.tokens) - 1)]

    def take(self) -> _Token:
        """Return the next token and go past it."""
        token = self.peek()
        self.position += 1
        return token

    def mistake(self, token: _Token, what: str) -> InputError:
        """Return the error for a token; the text of files outside the case is not shown."""
        if len(self.files) > 1 and not self.files[-1].is_relative_to(real(self.source.case)):
            return self.source.mistake(token.line, "the included file is not a dictionary.")
        return self.source.mistake(token.line, f"'{token.text}' {what}")


def _depth(entry: Entry) -> int:
    """Return the depth of an entry."""
    return sum(1 for _ in _upward(entry)) - 1


def _extent(entry: Entry) -> tuple[int, int]:
    """Return the number of words in an entry, and the depth of nested dictionaries in it."""
    if isinstance(entry, Stream):
        return 1 + len(entry.tokens), 0
    inner: Collection[Entry] = ()
    if isinstance(entry, Dictionary):
        inner = entry.entries.values()
    elif isinstance(entry, DictionaryList):
        inner = entry.items
    extents = [_extent(one) for one in inner]
    return 1 + sum(size for size, _ in extents), 1 + max((height for _, height in extents), default=0)


def _upward(entry: Entry) -> Iterator[Entry]:
    """Yield an entry and its parents, up to the top of the file."""
    above: Entry | None = entry
    while above is not None:
        yield above
        above = above.parent


def _descend(dictionary: Dictionary, name: str) -> Entry | None:
    """Find ``a.b`` or, in a nested dictionary ``a``, ``b``."""
    if name in dictionary.entries:
        return dictionary.entries[name]
    for key in reversed(dictionary.entries):
        # The last pattern counts.
        if key.startswith('"') and matches(key[1:-1], name):
            return dictionary.entries[key]
    first, _, inner_name = name.partition(".")
    inner = dictionary.entries.get(first)
    return _descend(inner, inner_name) if isinstance(inner, Dictionary) and inner_name else None
