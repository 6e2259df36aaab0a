"""The commands of `reftrace`, one file each: `add` its options, `run` it."""
