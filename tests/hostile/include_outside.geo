// must not: reads a file outside
// says: outside the folder of its scene
//@SQUARE@
Include "@OUTSIDE@/secret.geo";
