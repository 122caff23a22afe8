"""The trials of torture.py that spoil a file of a run folder and then use the folder."""


def trials(bench, rng):
    return []
