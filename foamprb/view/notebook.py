"""Results of a run for a notebook: ``foamprb.open_run``."""

from __future__ import annotations

import html
from dataclasses import dataclass
from importlib.metadata import version
from os import PathLike
from pathlib import Path
from typing import Any

from foamprb.flow.read.source import FlowSource
from foamprb.view import results as files
from foamprb.view.results import Run

_HEIGHT = 700
"""Height of the frame of a page, pixels."""
_UNTRUSTED = "This notebook is not trusted. To see the page, run the cell or take File &gt; Trust Notebook."
"""Text in the frame: Jupyter removes a frame from outputs that another user has computed, but no text."""


@dataclass(frozen=True)
class ViewPage:
    """Page of ``foamprb view``; a notebook shows it."""

    path: Path

    def _repr_html_(self) -> str:
        text = html.escape(self.path.read_text(encoding="utf-8"))
        size = f'width="100%" height="{_HEIGHT}" frameborder="0"'
        return f'<iframe title="foamprb view" srcdoc="{text}" {size}>{_UNTRUSTED}</iframe>'


@dataclass(frozen=True, repr=False)
class CaseRun(Run):
    """Results of one cloud, with the case that they belong to."""

    case: Path
    root: Path | None
    """Folder of the results instead of ``postProcessing`` in the case."""

    def view(self, path: Path | str | None = None, max_size: float = 30.0, **options: Any) -> ViewPage:
        """Write the page of ``foamprb view``, and return it; errors as :func:`foamprb.view.show.write_page`.

        Parameters
        ----------
        path
            The file; by default beside the results.
        max_size
            Largest size, MB.
        options
            Fields of :class:`foamprb.view.show.Request`: ``time``, ``colour``, ``enlargement``, ``slice``, ….
        """
        from foamprb.view.show import Request, write_page

        region = self.results.region
        source = FlowSource(region=region) if region else None
        request = Request(self.case, self.name, source, results=self.root, **options)
        target = None if path is None else Path(path)
        return ViewPage(write_page(request, target, max_size, version("foamprb")))


def open_run(
    path: PathLike[str] | str,
    cloud: str | None = None,
    region: str = "",
    results: PathLike[str] | str | None = None,
) -> CaseRun:
    """Open the results of a cloud of a case.

    Parameters
    ----------
    path
        Folder of the case.
    cloud
        Name of the cloud; by default ``softCloud``, or the only one.
    region
        Region of the mesh; by default the default region, or any other if that has no results.
    results
        Folder of the results if the run wrote them elsewhere than into ``postProcessing`` of the case.

    Raises
    ------
    InputError
        If there are no results, or several clouds without a name; if the list of files or the last file is
        damaged.
    """
    root = None if results is None else Path(results)
    run = files.open_run(path, cloud, region, root)
    return CaseRun(run.results, run.entries, run.units, run.names, run.components, Path(path), root)
