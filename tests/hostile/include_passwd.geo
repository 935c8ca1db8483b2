// must not: reads a file of the system
// says: outside the folder of its scene
//@SQUARE@
Include "/etc/passwd";
