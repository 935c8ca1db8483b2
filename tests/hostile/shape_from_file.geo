// must not: reads a shape outside
// says: outside the folder of its scene
//@SQUARE@
SetFactory("OpenCASCADE");
v() = ShapeFromFile("@OUTSIDE@/secret.step");
