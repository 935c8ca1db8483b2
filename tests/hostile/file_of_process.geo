// must not: reads the memory of processes
// says: outside the folder of its scene
//@SQUARE@
Include "/proc/self/environ";
