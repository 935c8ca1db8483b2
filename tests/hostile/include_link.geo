// must not: reads a file by a link
// says: outside the folder of its scene
//@SQUARE@
Include "link.geo";
