"""Why a pixel differs: causes, each with its check, and how many pixels have them."""
