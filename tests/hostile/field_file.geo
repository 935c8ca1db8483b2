// must not: reads a size field outside
// says: outside the folder of its scene
//@SQUARE@
Field[1] = Structured;
Field[1].FileName = "@OUTSIDE@/secret.geo";
Field[1].TextFormat = 1;
Background Field = 1;
