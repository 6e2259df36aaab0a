"""What the user sees: panels, operators, properties, menus."""
