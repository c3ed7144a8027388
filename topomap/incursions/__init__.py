"""Incursions: ways across open space, and the islands found on them."""
