"""Validation: foamprb against independent solutions and the paper's figures, by one command."""
