"""Other programs on the same meshes, each a module that runs under a Python that has it."""
