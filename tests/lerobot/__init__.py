"""A data set that tacgrasp wrote, loaded by the real lerobot package; see ``make test-lerobot``."""
