"""The cloud functions, by the word that ``type`` selects."""

from __future__ import annotations

from foamprb.cloudfunctions.base import CloudFunction
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.suspension_stress import SuspensionStress

__all__ = ["FUNCTIONS"]

FUNCTIONS: dict[str, type[CloudFunction]] = {
    "particleCollector": ParticleCollector,
    "particleHistogram": ParticleHistogram,
    "particleTracks": ParticleTracks,
    "patchPostProcessing": PatchPostProcessing,
    "suspensionStress": SuspensionStress,
}
