"""What reads and writes files: arrays, scenes, certificates, pictures, and JSON that is checked."""
