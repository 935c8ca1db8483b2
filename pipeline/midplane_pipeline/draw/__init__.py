"""Pictures of results, checks, paths of a law and studies."""
