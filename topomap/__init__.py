"""Topological mapping and map merging with sensing-limited robots."""
