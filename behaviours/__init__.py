"""Automata: what a robot with a few short-range sensors is able to do."""
