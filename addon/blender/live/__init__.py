"""The 3D view in *Rendered* mode: its camera, its picture in steps, and how it is drawn."""
