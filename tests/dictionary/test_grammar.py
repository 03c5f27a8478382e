"""The grammar of OpenFOAM's dictionaries: macros, includes, and the one message for each mistake."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from cloud_dictionary import Reader
from foamlib import FoamFile
from hypothesis import given
from hypothesis import strategies as st
from paths import PIPE

from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistake
from foamprb.dictionary.tree import Dictionary, Stream
from foamprb.errors import InputError


def dictionary(folder: Path, text: str) -> Dictionary:
    (folder / "dictionary").write_text(text)
    return read_dictionary(folder / "dictionary", folder)


def tree(entry: object) -> object:
    """Nested dicts of strings."""
    if isinstance(entry, Dictionary):
        return {key: tree(value) for key, value in entry.entries.items()}
    assert isinstance(entry, Stream)
    return entry.text


def test_entries_that_stand_twice_in_a_file_are_named(tmp_path, caplog):
    """Those of a macro or another file are meant to be replaced."""
    (tmp_path / "other").write_text("nu 1;")
    text = 'base { a 1; }\n#include "other"\nnu 2; nu 3;\nx { $base; a 2; }\ny { d 1; }\ny { d 2; }'
    (tmp_path / "dictionary").write_text(text)
    read_dictionary(tmp_path / "dictionary", tmp_path)
    assert not caplog.messages
    root = read_dictionary(tmp_path / "dictionary", tmp_path, warn=True)
    assert caplog.messages == [
        "dictionary, line 3: nu stands in line 3 too: the last one counts.",
        "dictionary, line 6: y stands in line 5 too: both are merged.",
    ]
    assert tree(root) == {"base": {"a": "1"}, "nu": "3", "x": {"a": "2"}, "y": {"d": "2"}}


@given(st.text(st.sampled_from('abc1.$:#{}()[];"/*\\ \n')) | st.text())
def test_any_text_is_read_or_refused(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = tmp_path_factory.getbasetemp()
    file = folder / "dictionary"
    file.write_bytes(text.encode("utf-8", errors="surrogatepass"))
    try:
        entries = read_dictionary(file, folder)
    except InputError as error:
        assert "dictionary" in str(error)  # noqa: PT017
    else:
        assert isinstance(tree(entries), dict)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", {}),
        ("a 1; a 2;", {"a": "2"}),
        ("a { b 1; c 1; } a { b 2; }", {"a": {"b": "2", "c": "1"}}),
        ("a { b 1; } a 2;", {"a": "2"}),
        ("a; b { };", {"a": "", "b": {}}),
        ("a b c ( d e );", {"a": "b c ( d e )"}),
        # As in twoPhaseEulerFoam's phaseProperties.
        ("a ( (x and y) 0.07 );", {"a": "( ( x and y ) 0.07 )"}),
        (
            "a ( (x in y) { b c; } (y in x) { b d; } ); e 1;",
            {"a": "( ( x in y ) { b c ; } ( y in x ) { b d ; } )", "e": "1"},
        ),
        ('"a.*" "b;}";', {'"a.*"': '"b;}"'}),
        ("a 1; b $a; c ${a}; d ($a 0 $a);", {"a": "1", "b": "1", "c": "1", "d": "( 1 0 1 )"}),
        ("a 1; b { c $a; a 2; d $a; }", {"a": "1", "b": {"c": "1", "a": "2", "d": "2"}}),
        ("a { x 1; } b $a; a { x 2; } c $a.x;", {"a": {"x": "2"}, "b": {"x": "1"}, "c": "2"}),
        ("a { x 1; y 1; } b { y 0; $a; x 2; }", {"a": {"x": "1", "y": "1"}, "b": {"y": "1", "x": "2"}}),
        (
            "x 1; a { x 2; b { p $:x; q $..x; r $x; } } c $:a.x;",
            {"x": "1", "a": {"x": "2", "b": {"p": "1", "q": "2", "r": "2"}}, "c": "2"},
        ),
        ("x 1; a { x 2; b $.x; }", {"x": "1", "a": {"x": "2", "b": "2"}}),
        (
            "a Gauss multivariateSelection { b upwind; c linear; }; d 1;",
            {"a": "Gauss multivariateSelection { b upwind ; c linear ; }", "d": "1"},
        ),
        ("f { #includeFunc probes(p, U)\n#includeFunc y }\nd 1;", {"f": {"#includeFunc": "y"}, "d": "1"}),
        ("a { b 1; c $b; } a { d 1; }", {"a": {"b": "1", "c": "1", "d": "1"}}),
        ("a.b 1; c $a.b;", {"a.b": "1", "c": "1"}),
        ("a { x 1; } b { $a } c 1;", {"a": {"x": "1"}, "b": {"x": "1"}, "c": "1"}),
        # As in fvSolution: a pattern has the name; a word may have parentheses.
        (
            '"(U|k)" { a 1; } F { $U; cache { grad(U); } }',
            {'"(U|k)"': {"a": "1"}, "F": {"a": "1", "cache": {"grad(U)": ""}}},
        ),
        # As in decayIsoTurb: the dictionary that another entry names.
        (
            "k { C 1; } b { m k; ${:$m}; d ${:${m}.C}; }",
            {"k": {"C": "1"}, "b": {"m": "k", "C": "1", "d": "1"}},
        ),
    ],
)
def test_macros_and_duplicates(tmp_path: Path, text: str, expected: object) -> None:
    root = dictionary(tmp_path, text)
    assert tree(root) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a\n{ b 1;\n", "line 2: '{' of a has no closing }."),
        ("a 1;\n}", "line 2: '}' stands where a key is expected."),
        ("a 1;\nb 2", "line 2: 'b' has no closing ;."),
        ("a 1\nb { }", "line 1: 'a' has no closing ;."),
        ("a 1\nb { c 1; }\nd 1;", "line 1: 'a' has no closing ;."),
        ("a { b 1 }", "line 1: 'b' has no closing ;."),
        ("a (1 2;\nb 2;", "line 1: 'a' has no closing )."),
        ("a (1 2];", "line 1: 'a' has no closing )."),
        ('a 1;\nb "c;\n', "line 2: this string has no end."),
        ("a 1; /* b\n", "line 1: this comment has no end."),
        ("a ( b { } c 1 );", "line 1: 'c' in the list a is not a name with its dictionary { … }."),
        ("a ( b { } )", "line 1: 'a' has no closing ;."),
        ("\na $b;", "line 2: '$b' is not defined above."),
        ("a { $b; } b { }", "line 1: '$b' is not defined above."),
        ("a 1; b { c $..d; }", "line 1: '$..d' is not defined above."),
        ("a 1; b { c $.a; }", "line 1: '$.a' is not defined above."),
        ("a { b 1; c $:a.b; }", "line 1: '$:a.b' is not defined above."),
        ("a 1; $a;", "line 1: '$a' stands where a key is expected, but is '1', not a dictionary."),
        ("a { } b (0 $a 0);", "line 1: '$a' is a dictionary, and cannot stand within a value."),
        ("#inputMode merge", "line 1: '#inputMode' is not supported. Did you mean"),
        ("a 1;\n#calc 2;", "line 2: '#calc' is not supported."),
        ("#codeStream { code #{ x; #}; };", "line 1: '#codeStream' is not supported."),
        ("#include", "line 1: '#include' names no file."),
        ('#include "gone"', "line 1: '\"gone\"' cannot be included: No such file or directory."),
        ('#include "dictionary"', "line 1: '\"dictionary\"' includes itself."),
    ],
)
def test_syntax_errors(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        dictionary(tmp_path, text)
    assert str(caught.value).startswith(f"dictionary, {message}")


def test_a_computed_value_is_refused_where_it_is_needed(read: Reader) -> None:
    with pytest.raises(InputError, match=r"solution/deltaT is '#calc .*', which is not evaluated"):
        read(("2e-05", '#calc "1e-5*2"'))
    with pytest.raises(InputError, match=r"solution/deltaT is '#eval \{ 1e-5\*2 \}', which is not evaluated"):
        read(("2e-05", "$dt"), ("FoamFile", "dt #eval{ 1e-5*2 }; FoamFile"))


def test_a_macros_variable_may_have_any_name(read: Reader) -> None:
    settings = read(("FoamFile", "size 2e-6; FoamFile"), ("value 5e-6;", "value $size;"))
    assert settings.injections[0].sizeDistribution.value == 2e-6
    settings = read(
        ("injectionModels\n    {", "injectionModels { size 2e-6;"), ("value 5e-6;", "value $size;")
    )
    assert len(settings.injections) == 1
    settings = read(
        ("deltaT          2e-05;", "one 1e-5; two { one $one; deltaT $one; three $one; } deltaT $two.deltaT;")
    )
    assert settings.solution.deltaT == 1e-5


def test_includes(case: Path, read: Reader) -> None:
    (case / "shared").mkdir()
    (case / "shared/time").write_text('FoamFile { } #include "step"\nendTime 2;')
    (case / "shared/step").write_text("deltaT 0.5;")
    (case / "system").mkdir()
    (case / "system/step").write_text("deltaT 0.25;")
    lines = ("deltaT          2e-05;\n    endTime         0.4;", "{}")

    def deltaT(text: str) -> float:
        return read((lines[0], text)).solution.deltaT

    assert deltaT('#include "../shared/time"') == 0.5
    assert deltaT('#include "../shared/time"\n deltaT 0.1;') == 0.1
    assert deltaT('endTime 2; #include "<system>/step"') == 0.25
    assert deltaT('endTime 2; #include "$FOAM_CASE/system/step"') == 0.25
    assert deltaT('endTime 2; deltaT 0.1; #includeIfPresent "none"') == 0.1
    assert deltaT('endTime 2; deltaT 0.1; #sinclude "../system/step"') == 0.25
    (case / "shared/step").write_text("\ndeltat 0.5;")
    with pytest.raises(
        InputError, match=r"^shared/step, line 2: solution/deltat is not known\. Did you mean"
    ):
        deltaT('#include "../shared/time"')
    (case / "shared/step").write_text('#include "time"')
    with pytest.raises(InputError, match=r"^shared/step, line 1: '\"time\"' includes itself"):
        deltaT('#include "../shared/time"')


@pytest.mark.parametrize(
    "file",
    ["constant/g", "constant/transportProperties", "system/fvSolution", "constant/softCloudProperties"],
)
def test_dictionary_agrees_with_foamlib(file):
    """An independent parser finds the same keys and numbers where no macro is used."""
    ours = read_dictionary(PIPE / file, PIPE)

    def compare(entries, expected):
        for key, value in expected.items():
            if key is None or key == "FoamFile" or key.startswith("$"):
                continue
            entry = entries[key]
            if isinstance(value, Mapping):
                compare(entry.dictionary().entries, value)
            elif isinstance(value, int | float) and not isinstance(value, bool):
                assert float(entry.text) == value

    compare(ours.entries, FoamFile(PIPE / file).as_dict())


def test_a_word_without_end_does_not_hide_the_message():
    message = str(Mistake("constant/x", 3, f"{'y' * 1_000_000} is not known."))
    assert message == f"constant/x, line 3: {'y' * 60}... is not known."


@pytest.mark.parametrize("macro", ["$/x", "$!x", "${x:-1}", "${x:+1}"])
def test_macros_of_later_versions_are_named(macro, tmp_path):
    (tmp_path / "d").write_text(f"x 1;\na {macro};\n")
    with pytest.raises(InputError, match=r"line 2: .* is a macro of OpenFOAM that is not supported"):
        read_dictionary(tmp_path / "d", tmp_path)


@pytest.mark.parametrize("name", ["$HOME/own", "${HOME}/own", "~/own"])
def test_the_users_folder_and_a_byte_order_mark(name, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "own").write_text("x 1;\n")
    (tmp_path / "d").write_bytes(f'\ufeff#include "{name}"\n'.encode())
    assert read_dictionary(tmp_path / "d", tmp_path).entries["x"].text == "1"
