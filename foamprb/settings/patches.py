"""OpenFOAM's patch interaction models, and the match of their rules with the patches of a mesh.

A new patch interaction model is a function from its ``…Coeffs`` to rules and a line in
:data:`INTERACTION_MODELS`.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from foamprb.cloud.patches import INTERACTIONS, Cyclic, Escape, Interaction, Mirror, Rebound, Stick
from foamprb.dictionary.constraints import Bounds, Choice, Meaning
from foamprb.dictionary.mistakes import Mistakes, ReportedError
from foamprb.dictionary.patterns import matches
from foamprb.dictionary.schema import read_entries, read_entry, read_model
from foamprb.dictionary.tree import Dictionary, DictionaryList, unquoted
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Flow, Patch
from foamprb.flow.patches import PatchKind

log = logging.getLogger("foamprb")

Touching: TypeAlias = Literal["ellipsoid", "centre"]
"""Part of a particle that touches a wall."""


@dataclass(frozen=True)
class PatchRule:
    """Interaction of the patches whose name or group equals ``pattern`` or, as a ``regex``, matches it."""

    pattern: str
    interaction: Interaction
    regex: bool = False
    line: int = field(default=0, compare=False)
    """Line in the file of the settings."""

    def matches(self, word: str) -> bool:
        """Return whether the whole ``word`` equals or matches the pattern."""
        return matches(self.pattern, word) if self.regex else self.pattern == word


@dataclass(frozen=True)
class KindRule:
    """Interaction of all patches of a kind: walls, open (neither walls nor constrained), or any."""

    kind: Literal["wall", "open", "any"]
    interaction: Interaction


Rule: TypeAlias = PatchRule | KindRule


# ---------------------------------------------------------------------------------------------------------
# Patch interaction models


def read_patch_interaction(sub_models: Dictionary) -> tuple[tuple[Rule, ...], Touching]:
    """Read the coefficients of the ``patchInteractionModel`` of ``subModels``.

    Returns
    -------
    The rules for the patches, and the part of a particle that touches a wall.
    """
    if "patchInteractionModel" not in sub_models.entries:
        raise ReportedError("patchInteractionModel is missing")
    model = read_entry(sub_models, "patchInteractionModel", Annotated[str, Choice(INTERACTION_MODELS)])
    coefficients: Dictionary = read_entry(sub_models, f"{model}Coeffs", Dictionary)
    mistakes = Mistakes()
    with mistakes:
        touching = read_entries(AnyInteraction, coefficients, also=coefficients.entries).touching
    with mistakes:
        rules = INTERACTION_MODELS[model](coefficients)
    mistakes.raise_any()
    return rules, touching


@dataclass(frozen=True, kw_only=True)
class LocalInteraction:
    """``localInteractionCoeffs``: patch by patch."""

    patches: Annotated[
        DictionaryList,
        Meaning(
            "`( pattern { type …; } … )`: a name, a group (`wall`) or a quoted regular expression; the first "
            "match counts. Symmetry planes, wedges, empty patches and patches without faces need no entry"
        ),
    ]


def _local_interaction(coefficients: Dictionary) -> tuple[Rule, ...]:
    """Return a rule for each entry of ``patches``."""
    mistakes, rules = Mistakes(), []
    with mistakes:
        entries = read_entries(LocalInteraction, coefficients, also=("touching",))
        for entry in entries.patches.items:
            with mistakes:
                rules.append(patch_rule(entry))
    mistakes.raise_any()
    return tuple(rules)


def patch_rule(dictionary: Dictionary) -> PatchRule:
    """Read an entry of ``patches``."""
    pattern, regex = unquoted(dictionary.key), dictionary.key.startswith('"')
    if regex:
        try:
            re.compile(pattern)
        except re.error as error:
            raise dictionary.mistake(f"is not a regular expression: {error}.") from error
    return PatchRule(pattern, read_model(INTERACTIONS, dictionary), regex, dictionary.line)


@dataclass(frozen=True, kw_only=True)
class StandardWallInteraction:
    """``standardWallInteractionCoeffs``: one interaction for all walls; open patches let particles out."""

    type: Annotated[
        str,
        Choice(INTERACTIONS),
        Meaning("with the entries of that type, for every wall"),
    ]


@dataclass(frozen=True, kw_only=True)
class AnyInteraction:
    """Entries of the ``…Coeffs`` of every model."""

    touching: Annotated[
        Touching, Meaning("part of the particle that touches a wall: the body, or only its centre")
    ] = "ellipsoid"


def _standard_wall_interaction(coefficients: Dictionary) -> tuple[Rule, ...]:
    """Return one rule for all walls, and that particles leave through open patches."""
    walls = read_model(INTERACTIONS, coefficients, also=("touching",))
    return KindRule("wall", walls), KindRule("open", Escape())


@dataclass(frozen=True, kw_only=True)
class ReboundFromAll:
    """``reboundCoeffs``: particles bounce off every patch."""

    UFactor: Annotated[
        float,
        Bounds(0.5, 1.0, False, False, "a number from 0.5 to 1"),
        Meaning("they bounce off every patch, with e = 2 `UFactor` − 1", "1"),
    ]


def _rebound(coefficients: Dictionary) -> tuple[Rule, ...]:
    """Return the rule that particles bounce off every patch and lose 2 UFactor of the normal velocity."""
    entries = read_entries(ReboundFromAll, coefficients, also=("touching",))
    return (KindRule("any", Rebound(e=2.0 * entries.UFactor - 1.0)),)


INTERACTION_MODELS: dict[str, Callable[[Dictionary], tuple[Rule, ...]]] = {
    "localInteraction": _local_interaction,
    "rebound": _rebound,
    "standardWallInteraction": _standard_wall_interaction,
}
"""Functions from coefficients to rules, by the word that ``patchInteractionModel`` selects."""


# ---------------------------------------------------------------------------------------------------------
# Rules and patches


def match_patches(rules: Sequence[Rule], patches: Sequence[Patch], file: Path | str) -> list[Interaction]:
    """Return the interaction of each patch, by the rules of OpenFOAM's patch interaction models.

    The first rule counts whose pattern matches the patch's name or its group: ``wall``, or a constraint type.
    Without a rule, symmetry planes and empty patches mirror a particle. It continues at the neighbour of a
    coupled patch or a wedge, unless a rule equals the patch's name.

    Parameters
    ----------
    rules, patches
        Rules of the settings and patches of the mesh.
    file
        The file that a message names.

    Raises
    ------
    InputError
        If rules match no patch, or patches of other kinds have no rule; all of them.
    """
    where = f"{file}: subModels/localInteractionCoeffs/patches"
    names = [patch.name for patch in patches]
    mistakes, interactions = Mistakes(), []
    for rule in rules:
        if isinstance(rule, PatchRule) and not any(applies(rule, patch) for patch in patches):
            text = f"{where}/{rule.pattern} matches no patch. {suggestion(rule.pattern, names)}"
            mistakes.add(InputError(text))
    # A rule without a match may explain a patch without a rule.
    mistakes.raise_any()
    for patch in patches:
        with mistakes:
            interactions.append(_interaction(rules, patch, file, where))
    mistakes.raise_any()
    for rule in rules:
        if isinstance(rule, PatchRule):
            _warn_if_hidden(rule, rules, patches, where)
    return interactions


def _warn_if_hidden(rule: PatchRule, rules: Sequence[Rule], patches: Sequence[Patch], where: str) -> None:
    """Warn of a rule that counts for no patch, but for a pattern after the names of all that it matches."""
    counting = [_rule_of(rules, patch) for patch in patches if applies(rule, patch)]
    others = [r for r in counting if isinstance(r, PatchRule) and (r.regex or not rule.regex)]
    if others and not any(r is rule for r in counting):
        log.warning(
            "%s/%s, line %d, has no effect: %s in line %d matches first.",
            where, rule.pattern, rule.line, others[0].pattern, others[0].line,
        )  # fmt: skip


def patch_interactions(
    flow: Flow,
    wall: Interaction = Stick(),  # noqa: B008
    other: Interaction = Escape(),  # noqa: B008
) -> list[Interaction]:
    """Return the interaction of each patch of a flow, for :class:`foamprb.cloud.cloud.Cloud`.

    Parameters
    ----------
    flow
        A flow. Particles continue at the neighbours of its coupled patches, and symmetry planes and empty
        patches mirror them.
    wall, other
        Interactions of walls, and of the patches of other types, as inlets and outlets.

    Raises
    ------
    InputError
        If particles cannot pass through a coupled patch.
    """
    return match_patches([KindRule("wall", wall), KindRule("open", other)], flow.patches, "interactions")


def _interaction(rules: Sequence[Rule], patch: Patch, file: Path | str, where: str) -> Interaction:
    kind, rule = patch.kind, _rule_of(rules, patch)
    if rule is not None:
        return rule.interaction
    if kind is PatchKind.PASSABLE:
        return Cyclic()
    if kind in (PatchKind.MIRROR, PatchKind.FACELESS):
        return Mirror()
    if patch.type == "cyclic":
        raise InputError(f"{where}: the cyclic patch '{patch.name}' has no neighbourPatch.")
    if kind is PatchKind.COUPLED:
        raise InputError(
            f"{file}: particles cannot pass through '{patch.name}', a patch of type {patch.type}. They "
            "only pass cyclic and cyclicAMI patches that coincide with their neighbours. "
            f"Give it an entry of its own ({', '.join(INTERACTIONS)})."
        )
    raise InputError(f"{where} has no entry for the patch '{patch.name}'.")


def _rule_of(rules: Sequence[Rule], patch: Patch) -> Rule | None:
    """Return the rule that counts for a patch, if there is one."""
    for rule in rules:
        is_named = rule == PatchRule(patch.name, rule.interaction)
        if is_named or (applies(rule, patch) and patch.kind is not PatchKind.PASSABLE):
            return rule
    return None


def applies(rule: Rule, patch: Patch) -> bool:
    """Return whether a rule matches a patch; ``.*`` does not name a coupled one."""
    kind = patch.kind
    plain = kind in (PatchKind.WALL, PatchKind.OPENING)
    if isinstance(rule, KindRule):
        return rule.kind in ("any", "wall" if kind is PatchKind.WALL else "open" if plain else "constrained")
    if kind is PatchKind.COUPLED and rule.matches(""):
        return False
    group = {"wall"} if kind is PatchKind.WALL else set() if plain else {patch.type}
    return any(map(rule.matches, (patch.name, *patch.groups, *group)))
