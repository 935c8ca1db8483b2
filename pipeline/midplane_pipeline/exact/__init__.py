"""Exact solutions of scenes of the gallery, in closed form."""
