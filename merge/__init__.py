"""Merging of maps that share no frame, on plain graphs and arrays."""
