"""A module for each engine: NAME, VERSION, SETTING (in words) and `load(scene)`."""
