#!/bin/bash
# A Slurm array: each task does a chunk of the frames FIRST to LAST, or of a picture's rows.
#
#   sbatch --array=0-24 slurm.sh render  FILE.blend FOLDER 1 250 10
#   sbatch --array=0-24 slurm.sh compare FILE.blend FOLDER 1 250 10
#   sbatch --array=0-7  slurm.sh trace   FILE.npz   FOLDER 0 2159 270
#
# Submit it from its own folder, in which frames.py lies, too. FILE and FOLDER are absolute paths.
#SBATCH --job-name=reference-tracer --output=%x-%A-%a.log
set -euo pipefail

work=$1 file=$2 folder=$3 begin=$4 end=$5 size=$6
first=$((begin + SLURM_ARRAY_TASK_ID * size))
last=$((first + size - 1))
last=$((last < end ? last : end))
case $work in
    render)
        blender -b "$file" -E REFERENCE_TRACER -F PNG -o "$folder/####" \
            --python-exit-code 1 -P "$SLURM_SUBMIT_DIR/frames.py" -- "$first-$last"
        ;;
    compare)
        blender "$file" --command reference_tracer compare \
            --frames "$first-$last" --out "$folder/compared"
        ;;
    trace)
        reftrace trace "$file" --rows "$first" "$last" \
            --out "$folder/rows_$(printf %05d "$first").png"
        ;;
esac
