// A job type of Flamenco: renders frames, and compares each with what Blender shows.
const JOB_TYPE = {
    label: "Reference Tracer",
    settings: [
        { key: "blendfile", type: "string", required: true, visible: "web" },
        { key: "frames", type: "string", required: true,
          eval: "f'{C.scene.frame_start}-{C.scene.frame_end}'" },
        { key: "chunk_size", type: "int32", default: 10 },
        { key: "folder", type: "string", subtype: "dir_path", required: true },
        { key: "script", type: "string", subtype: "file_path", required: true },  // frames.py
    ],
};

function compileJob(job) {
    const { blendfile, frames, chunk_size, folder, script } = job.settings;
    const blender = (...args) => author.Command("blender-render",
        { exe: "{blender}", exeArgs: "{blenderArgs}", argsBefore: [], blendfile, args });
    for (const chunk of frameChunker(frames, chunk_size)) {  // "1-10", or "1,2,7-9"
        const render = author.Task(`render ${chunk}`, "blender");
        render.addCommand(blender("-E", "REFERENCE_TRACER", "-F", "PNG", "-o", `${folder}/####`,
            "--python-exit-code", "1", "-P", script, "--", chunk));
        const compare = author.Task(`compare ${chunk}`, "blender");
        for (const range of chunk.split(","))
            compare.addCommand(blender("--command", "reference_tracer", "compare",
                "--frames", range, "--out", `${folder}/compared`));
        [render, compare].forEach(task => job.addTask(task));
    }
}
