"""The scenarios of numerical stability: `sweeps.toml` lists them."""
