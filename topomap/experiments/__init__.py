"""Named experiments: each measures a claim, with its interval, again and again."""
