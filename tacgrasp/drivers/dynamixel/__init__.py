"""TODO: what this folder is for, what it may import."""
