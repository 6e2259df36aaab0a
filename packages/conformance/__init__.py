"""A kit of small scenes that judges other renderers and exporters."""
