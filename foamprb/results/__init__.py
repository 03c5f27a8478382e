"""What a run leaves on disk: clouds for ParaView and tables."""
