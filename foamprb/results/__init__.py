"""Results of a run on disk: snapshots, tables, checkpoints, and their folder."""
