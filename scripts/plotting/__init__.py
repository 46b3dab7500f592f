"""Figures of coordreq results: a module a figure, which prepares what is drawn and draws it."""
