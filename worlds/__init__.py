"""Simulated worlds, and the bodies that robots have in them."""
