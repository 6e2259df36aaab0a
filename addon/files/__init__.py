"""Readers and writers of files: arrays, scenes, certificates, pictures, and checked JSON."""
