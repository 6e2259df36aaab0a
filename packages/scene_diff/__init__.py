"""Lists object by object how the geometry of two files of a scene differs: `reftrace diff`."""
