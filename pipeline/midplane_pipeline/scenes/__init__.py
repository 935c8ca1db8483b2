"""Scenes of the gallery that programs write."""
