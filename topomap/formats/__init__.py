"""Formats of others: maps, worlds and pose graphs, in and out."""
