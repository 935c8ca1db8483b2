"""Results of a scene from outside: files, fields, energies, statics, and what is known of it."""
