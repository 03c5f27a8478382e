"""Everything that a person looks at: the page, pictures and films, made from a run's results."""
