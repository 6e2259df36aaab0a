"""The other side: its picture, colours, palette, owners, and the certificate of its camera."""
