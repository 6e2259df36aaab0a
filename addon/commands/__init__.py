"""The commands of `reftrace`, a file each: `add` a parser's options, and `run` with them.

`blender --command` has some of them, for the file that is open.
"""

# In the order of the help: where a command's options are, and what it does. Those without a place
# are packages of their own.
COMMANDS = {
    "compare": (
        ".compare:add",
        "trace a scene and compare it with Blender's own picture, or with any other",
    ),
    "trace": (".files:add_trace", "trace a scene or a mesh into a picture"),
    "explain": (
        ".files:add_explain",
        "show the maths of one pixel's ray: every step, in float32, float64 and exactly",
    ),
    "judge": (None, "judge students' own ray/triangle tests (this runs their code)"),
    "trade": (
        ".studies:add_trade",
        "measure what every method, precision, number of samples and size costs on a scene",
    ),
    "extremes": (
        ".studies:add_extremes",
        "find where every method breaks: far away, tiny, edge-on, and so on",
    ),
    "bench": (None, "measure the speed of the tracer beside embreex, Cycles and others"),
    "export": (".files:add_export", "export a .blend to a scene that needs no Blender"),
}
