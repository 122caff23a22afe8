"""Anchors of headings as GitHub makes them, so that one link is valid in both places."""
import re


def github(text, separator):
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", separator)
