"""Training in stages, from files: CLIP, CLTP, the language model. It never calls ``sim``."""
