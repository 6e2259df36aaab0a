"""Pictures of data in place of colours: depths, normals, positions, ids; a kind a file."""
