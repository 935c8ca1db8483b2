// must not: merges a file outside
// says: outside the folder of its scene
//@SQUARE@
Merge "@OUTSIDE@/secret.geo";
