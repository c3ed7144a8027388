"""Routes: the ways of a map as behaviours, planned and driven."""
