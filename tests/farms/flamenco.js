// A stub of what Flamenco gives a job type: compiles a job, and prints its tasks as JSON.
// node flamenco.js JOB_TYPE.js SETTINGS
const fs = require("fs");
const vm = require("vm");

class Task {
    constructor(name, type) {
        Object.assign(this, { name, type, commands: [] });
    }
    addCommand(command) {
        this.commands.push(command);
    }
}

const author = {
    Task: (name, type) => new Task(name, type),
    Command: (name, parameters) => ({ name, parameters }),
};

// As Flamenco has it: two frames in a row are "1,2", more are "1-3".
function frameChunker(frames, size) {
    const all = frames.split(",").flatMap(part => {
        const [first, last = first] = part.split("-").map(Number);
        return Array.from({ length: last - first + 1 }, (_, k) => first + k);
    });
    const chunks = [];
    for (let k = 0; k < all.length; k += size) {
        const runs = [];
        for (const frame of all.slice(k, k + size)) {
            const run = runs.at(-1);
            if (run && run.at(-1) === frame - 1) run.push(frame);
            else runs.push([frame]);
        }
        chunks.push(runs.map(r => (r.length > 2 ? `${r[0]}-${r.at(-1)}` : r.join(","))).join(","));
    }
    return chunks;
}

const [, , path, settings] = process.argv;
const world = { author, frameChunker, job: { settings: JSON.parse(settings), tasks: [] } };
world.job.addTask = task => world.job.tasks.push(task);
vm.createContext(world);
vm.runInContext(fs.readFileSync(path, "utf-8"), world);
const type = vm.runInContext("compileJob(job); JOB_TYPE", world);
console.log(JSON.stringify({ type, tasks: world.job.tasks }));
