"""The command line: `reftrace`, and what `blender --command` shares with it."""
