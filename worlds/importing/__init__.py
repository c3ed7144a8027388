"""Worlds from files that others made: floor plans, robot maps, pictures."""
