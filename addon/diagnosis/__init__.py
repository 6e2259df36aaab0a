"""Diagnoses what is wrong with a picture: faults, each made, fitted and named."""
