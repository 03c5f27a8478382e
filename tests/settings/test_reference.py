"""Documentation of the entries, on the page and in ``foamprb help``, from the declarations."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from paths import PIPE, ROOT
from settings_reference import SECTIONS, entries_of, tables, texts, with_tables

from foamprb.cloud.forces import FORCES
from foamprb.dictionary.constraints import Only
from foamprb.errors import InputError
from foamprb.settings.help import FILE, explain, meaning, plain

PAGE = ROOT / "docs/settings.md"
EVERY = [text for name in SECTIONS for text in entries_of(name)]


def test_the_page_has_the_tables_that_the_declarations_make():
    """After a change of an entry: tools/settings_page."""
    page = PAGE.read_text(encoding="utf-8")
    assert with_tables(page) == page


def test_the_file_of_help_has_the_texts_of_the_declarations():
    """After a change of an entry: tools/settings_page."""
    assert FILE.read_text(encoding="utf-8") == texts().to_json()


VIEWERS = ("vtkmodules", "pyvista", "matplotlib")
HEAVY = ("numba", "llvmlite", "scipy", *VIEWERS)


@pytest.mark.parametrize(
    ("code", "absent"),
    [
        ("from foamprb.cli import main; main(['help', 'deltaT'])", ("numpy", *HEAVY)),
        ("import foamprb.settings.settings", HEAVY),
        (f"from foamprb.cli import main; main(['run', '-case', '{PIPE}', '-dry-run'])", VIEWERS),
        (f"from foamprb.cli import main; main(['info', '-case', '{PIPE}'])", ("scipy.spatial", *VIEWERS)),
    ],
)
def test_texts_and_declarations_need_no_compiler(code, absent):
    code += f"; import sys; print([name for name in {absent} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_the_page_without_one_of_its_tables_is_refused():
    page = PAGE.read_text(encoding="utf-8")
    with pytest.raises(InputError, match="the page has the tables"):
        with_tables(page.replace("<!-- table solid -->", ""))


def test_every_entry_is_explained():
    assert [text.path for text in EVERY if not (text.meaning and text.allowed)] == []
    assert [t.path for t in EVERY if not (t.why_idle or t.default or "/" not in t.name)] == []
    assert len(EVERY) > 150


def test_numbers_have_units_and_words_have_none():
    assert meaning("solution", "deltaT").unit == "s"
    assert meaning("injections", "parcelsPerSecond", "patchInjection").unit == "1/s"
    assert meaning("solution", "integrationSchemes/shape").unit == ""
    with pytest.raises(KeyError):
        meaning("solution", "none")


def test_defaults_are_those_that_are_read():
    assert meaning("solution", "integrationSchemes/tolerance").default == "0.0001"
    assert meaning("cloudFunctions", "nBins", "particleHistogram").default == "50"
    assert meaning("shape", "e1", "ellipsoid").default == "`(1 0 0)`"
    assert meaning("constantProperties", "rho0").default == "required"


def test_help_of_an_entry_says_unit_default_and_what_is_allowed():
    assert explain("deltaT") == [
        "solution/deltaT",
        "    tracking step",
        "    unit     s",
        "    default  that of system/controlDict",
        "    allowed  a number > 0",
    ]
    assert explain("solution/deltaT") == explain("deltaT")


def test_help_of_a_dictionary_within_a_section_says_what_is_in_it():
    said = explain("integrationSchemes")
    for name in ("shape", "tolerance"):
        assert set(explain(f"integrationSchemes/{name}")) <= set(said)
    assert explain("solution/integrationSchemes") == said
    with pytest.raises(InputError, match=r"Did you mean 'integrationSchemes'\?"):
        explain("integrationScheme")


def test_help_knows_all_that_the_page_does():
    for text in EVERY:
        name = text.name.rpartition("/")[2]
        assert any(text.path.partition(" (")[0] in line for line in explain(name)), text
    for name, section in SECTIONS.items():
        assert explain(name)
        for model in section.models:
            assert any(f"type {model}" in line for line in explain(model))
    for force in FORCES:
        assert any(force in line for line in explain(force))
    assert any(line.strip().startswith("Cvm") for line in explain("virtualMass"))
    assert all(name in "\n".join(explain(None)) for name in SECTIONS)


def test_help_explains_every_value_of_an_entry():
    """Its own entries are listed: of a capsule its membrane."""
    for text in EVERY:
        for value, said in text.values.items():
            lines = explain(value)
            title = lines.index(f"{text.full_name} {value}{f' ({text.model})' if text.model else ''}")
            assert plain(said or text.meaning).startswith(lines[title + 1].strip())
    said = "\n".join(explain("capsule"))
    assert "constantProperties/solid/type capsule" in said
    assert "surfacePoissonsRatio" in said
    assert "surfaceTension" not in said
    assert "stochasticDispersionRASCoeffs/seed" in "\n".join(explain("stochasticDispersionRAS"))
    with pytest.raises(InputError, match=r"Did you mean 'capsule'\?"):
        explain("capsul")


def test_help_leads_from_other_words_to_entries():
    first, *others = explain("modulus")
    assert first == "No entry is named 'modulus'. Related ones; foamprb help NAME has details:"
    assert any(line.startswith("    constantProperties/solid/shearModulus: shear modulus") for line in others)
    assert any(
        line.startswith("    constantProperties/solid/type neoHooke: ") for line in explain("microgel")
    )
    lines = explain("ion")
    assert len(lines) == 14
    assert re.fullmatch(r"    … and \d+ more", lines[-1])
    with pytest.raises(InputError, match="foamprb help lists all names"):
        explain("xyzzy")


def test_materials_and_models_have_a_sentence_each():
    named = ("solid/type", "tractionModel", "shapeModel", "dispersionModel", "patchInteractionModel")
    for text in EVERY:
        if text.full_name.endswith(named):
            assert all(text.values.values()), text.full_name


def test_help_suggests_a_name_for_an_unknown_one():
    with pytest.raises(InputError, match=r"'deltT'. Did you mean 'deltaT'\?"):
        explain("deltT")
    with pytest.raises(InputError, match="foamprb help lists all names"):
        explain("zzzzz")


def test_entries_without_effect_have_a_table_of_their_own():
    table = tables()["noEffect"]
    assert "| `solution/maxCo` |" in table
    assert "maxCo" not in tables()["solution"]


def test_an_entry_of_one_value_says_why():
    assert Only(False, "because").why in "because"
    assert "do not act on the flow" in meaning("solution", "coupled").meaning


def test_plain_text_has_no_marks_of_markdown():
    assert plain("[a b](c.md#d) of `e`") == "a b of e"
