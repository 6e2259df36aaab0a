"""The commands of `reftrace`, a file each: `add` declares a command's options.

Each command makes a frozen record of what was parsed, which checks it, and works from that.
`blender --command` has some of them, for the file that is open.
"""

HELP = {  # in the order of `reftrace --help`
    "compare": "trace a scene and compare it with Blender's own picture, or with any other",
    "trace": "trace a scene or a mesh into a picture",
    "explain": "show the maths of one pixel's ray: every step, in float32, float64 and exactly",
    "judge": "judge students' own ray/triangle tests (this runs their code)",
    "trade": "measure what every method, precision, number of samples and size costs on a scene",
    "extremes": "find where every method breaks: far away, tiny, edge-on, and so on",
    "bench": "measure the speed of the tracer beside embreex, Cycles and others",
    "export": "export a .blend to a scene that needs no Blender",
}
IN_PACKAGES = "judge", "bench"  # beside the add-on, found through their entry points
