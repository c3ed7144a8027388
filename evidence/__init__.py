"""Dempster-Shafer evidence, and the decision that a loop is closed."""
