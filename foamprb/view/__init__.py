"""Pages, pictures, films, reports and exports of the results of a run."""
