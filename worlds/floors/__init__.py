"""Worlds with halls: what joins what on a lattice, and then where it is."""
