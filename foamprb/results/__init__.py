"""Results of a run on disk: clouds for ParaView and tables."""
