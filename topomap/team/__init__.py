"""Several robots without a common frame: what they tell, merge, and choose."""
