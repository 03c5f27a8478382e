"""The cloud functions, by the word that ``type`` selects."""

from __future__ import annotations

from foamprb.cloudfunctions.base import CloudFunction
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.suspension_stress import SuspensionStress

__all__ = ["FUNCTIONS"]

FUNCTIONS: dict[str, type[CloudFunction]] = {
    "deformabilityCytometry": DeformabilityCytometry,
    "haemolysis": Haemolysis,
    "particleCollector": ParticleCollector,
    "particleHistogram": ParticleHistogram,
    "particleStatistics": ParticleStatistics,
    "particleTracks": ParticleTracks,
    "patchPostProcessing": PatchPostProcessing,
    "suspensionStress": SuspensionStress,
}
