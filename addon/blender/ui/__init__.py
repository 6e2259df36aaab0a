"""The interface: panels, operators, properties, menus."""
