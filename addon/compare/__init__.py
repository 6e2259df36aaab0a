"""Two pictures of one scene: how far they differ, and why."""
