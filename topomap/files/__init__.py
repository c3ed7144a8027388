"""Files: what is read is checked, what is written is written whole."""
