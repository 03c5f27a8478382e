"""What is said of the entries: by the page, by ``foamprb help``; all from the declarations."""

from __future__ import annotations

import pytest
from paths import ROOT

from foamprb.cloud.forces import FORCES
from foamprb.dictionary.constraints import Only
from foamprb.errors import InputError
from foamprb.settings.reference import SECTIONS, entries_of, explain, meaning, plain, tables, with_tables

PAGE = ROOT / "docs/settings.md"
EVERY = [text for name in SECTIONS for text in entries_of(name)]


def test_the_page_has_the_tables_that_the_declarations_make():
    """After a change of an entry: tools/settings_page."""
    page = PAGE.read_text(encoding="utf-8")
    assert with_tables(page) == page


def test_the_page_without_one_of_its_tables_is_refused():
    page = PAGE.read_text(encoding="utf-8")
    with pytest.raises(InputError, match="the page has the tables"):
        with_tables(page.replace("<!-- table solid -->", ""))


@pytest.mark.parametrize("text", EVERY, ids=lambda text: text.path)
def test_every_entry_is_explained(text):
    assert text.meaning
    assert text.allowed
    assert text.why_idle or text.default or "/" not in text.name


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
    assert all(name in "\n".join(explain(None)) for name in SECTIONS)


def test_help_of_what_does_not_exist_says_what_was_meant():
    with pytest.raises(InputError, match=r"'deltT'. Did you mean 'deltaT'\?"):
        explain("deltT")
    with pytest.raises(InputError, match="foamprb help lists all names"):
        explain("zzzzz")


def test_what_has_no_effect_is_in_a_table_of_its_own():
    table = tables()["noEffect"]
    assert "| `solution/maxCo` |" in table
    assert "maxCo" not in tables()["solution"]


def test_an_entry_of_one_value_says_why():
    assert Only(False, "because").why in "because"
    assert "do not act on the flow" in meaning("solution", "coupled").meaning


def test_marks_of_markdown_are_no_words():
    assert plain("[a b](c.md#d) of `e`") == "a b of e"
