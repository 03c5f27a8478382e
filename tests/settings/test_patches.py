"""Which patch does what: rules, groups and constraint types."""

from __future__ import annotations

import pytest
from cloud_dictionary import CLOUD, Reader

from foamprb.cloud.patches import Cyclic, Escape, Mirror, Rebound, Stick
from foamprb.errors import InputError
from foamprb.flow.base import Patch, patches_named
from foamprb.settings import patches as module
from foamprb.settings.patches import PatchRule

FILE = "constant/softCloudProperties"


def match_patches(rules: list[PatchRule], patches: list[Patch]) -> list[object]:
    return module.match_patches(rules, patches, FILE)


def patch(name: str, kind: str = "patch", neighbour: str = "") -> Patch:
    return Patch(name, kind, neighbour)


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        (
            [PatchRule("in", Stick()), PatchRule("out", Escape()), PatchRule("side", Stick())],
            [Stick(), Escape(), Stick()],
        ),
        (
            [PatchRule("side|.*n", Stick(), regex=True), PatchRule("out", Escape())],
            [Stick(), Escape(), Stick()],
        ),
        ([PatchRule("out", Escape()), PatchRule(".*", Stick(), regex=True)], [Stick(), Escape(), Stick()]),
        ([PatchRule(".*", Stick(), regex=True), PatchRule("out", Escape())], [Stick(), Stick(), Stick()]),
        (
            [PatchRule("(in|out)", Escape(), regex=True), PatchRule("wall", Stick())],
            [Escape(), Escape(), Stick()],
        ),
    ],
)
def test_the_first_rule_that_matches_counts(rules: list[PatchRule], expected: list[object]) -> None:
    assert match_patches(rules, [patch("in"), patch("out"), patch("side", "wall")]) == expected


def test_an_entry_behind_a_pattern_that_hides_it_is_named(caplog: pytest.LogCaptureFixture) -> None:
    """A pattern behind names is for the other patches of a mesh."""
    patches = [patch("in"), patch("out")]
    match_patches(
        [PatchRule("in", Stick()), PatchRule("out", Stick()), PatchRule(".*", Stick(), True)], patches
    )
    assert not caplog.messages
    match_patches([PatchRule(".*", Stick(), True, 7), PatchRule("out", Escape(), line=9)], patches)
    (said,) = caplog.messages
    assert said.endswith("patches/out, line 9, has no effect: .* in line 7 matches first.")


def test_patches_of_a_constraint_type() -> None:
    planes = [patch(name, name) for name in ("empty", "symmetry", "symmetryPlane", "wedge")]
    assert match_patches([], planes) == [Mirror()] * 4
    assert match_patches([PatchRule("symmetry", Stick())], planes)[1] == Stick()
    assert match_patches([PatchRule("wall", Stick())], [patch("to_solid", "mappedWall")]) == [Stick()]
    for kind in ("cyclic", "cyclicAMI", "wedge"):
        pair = [patch("left", kind, "right"), patch("right", kind, "left")]
        assert match_patches([], pair) == [Cyclic()] * 2
        assert match_patches([PatchRule(".*", Stick(), regex=True)], pair) == [Cyclic()] * 2
        assert match_patches([PatchRule("left", Escape())], pair) == [Escape(), Cyclic()]
    with pytest.raises(InputError, match="the cyclic patch 'left' has no neighbourPatch"):
        match_patches([], [patch("left", "cyclic")])
    for kind in ("cyclicAMI", "cyclicACMI"):
        with pytest.raises(InputError, match=f"cannot pass through 'left', a patch of type {kind}"):
            match_patches([], [patch("left", kind)])
    assert match_patches([PatchRule("left", Escape())], [patch("left", "cyclicAMI")]) == [Escape()]


def test_flows_whose_patches_need_no_entry_have_an_empty_list(read: Reader) -> None:
    text = CLOUD[CLOUD.index("    patchInteractionModel") : CLOUD.rindex("}")]
    empty = "patchInteractionModel localInteraction; localInteractionCoeffs { patches ( ); }"
    assert read((text, empty)).patches == ()


def test_standard_wall_interaction(read: Reader) -> None:
    """Walls do what the entries say, open patches let through, constraint types keep their meaning."""
    text = CLOUD[CLOUD.index("    patchInteractionModel") : CLOUD.rindex("}")]
    settings = read(
        (
            text,
            "patchInteractionModel standardWallInteraction; localInteractionCoeffs { } "
            "standardWallInteractionCoeffs { type rebound; e 0.97; mu 0.09; touching centre; }",
        )
    )
    assert (settings.interaction, settings.touching) == ("standardWallInteraction", "centre")
    patches = [
        patch("wall"),
        patch("side", "wall"),
        patch("mid", "symmetryPlane"),
        patch("out", "mappedPatch"),
    ]
    bounce = Rebound(e=0.97, mu=0.09)
    assert match_patches(settings.patches, patches) == [Escape(), bounce, Mirror(), Escape()]
    with pytest.raises(InputError, match="has no neighbourPatch"):
        match_patches(settings.patches, [patch("left", "cyclic")])


def test_rebound_from_every_patch(read: Reader) -> None:
    text = CLOUD[CLOUD.index("    patchInteractionModel") : CLOUD.rindex("}")]
    settings = read((text, "patchInteractionModel rebound; reboundCoeffs { UFactor 0.8; }"))
    patches = [patch("in"), patch("side", "wall"), patch("mid", "symmetryPlane")]
    assert match_patches(settings.patches, patches) == [Rebound(e=pytest.approx(0.6))] * 3
    with pytest.raises(InputError, match=r"UFactor is '0\.4'\. Allowed: a number from 0\.5 to 1"):
        read((text, "patchInteractionModel rebound; reboundCoeffs { UFactor 0.4; }"))


@pytest.mark.parametrize(
    ("rule", "message"),
    [
        (
            PatchRule("inlt", Stick()),
            "patches/inlt matches no patch. Did you mean 'inlet'? Allowed: inlet, outlet.",
        ),
        (PatchRule("in", Stick(), regex=True), "patches/in matches no patch."),
        (PatchRule("in.*", Stick()), "patches/in.* matches no patch."),
        (PatchRule("inlet", Stick()), "patches has no entry for the patch 'outlet'."),
    ],
)
def test_patches_without_a_rule_and_rules_without_a_patch(rule: PatchRule, message: str) -> None:
    with pytest.raises(InputError) as caught:
        match_patches([rule], [patch("inlet"), patch("outlet")])
    assert str(caught.value).startswith(
        "constant/softCloudProperties: subModels/localInteractionCoeffs/" + message
    )


def test_a_rule_for_a_group_of_the_case() -> None:
    patches = [
        Patch("in", "patch", groups=frozenset({"ends"})),
        Patch("a", "wall", groups=frozenset({"sides"})),
    ]
    for word, regex in (("ends", False), ("e.ds", True)):
        rules = [PatchRule(word, Escape(), regex), PatchRule("sides", Stick())]
        assert match_patches(rules, patches) == [Escape(), Stick()]


def test_names_groups_and_patterns_of_patches() -> None:
    patches = [
        Patch("in", "patch"),
        Patch("in2", "patch", groups=frozenset({"ends", "in"})),
        Patch("out", "patch", groups=frozenset({"ends"})),
    ]
    words = {"in": [0], "ends": [1, 2], "in.*": [0, 1], "(": [], "none": []}
    assert {word: patches_named(patches, word) for word in words} == words
