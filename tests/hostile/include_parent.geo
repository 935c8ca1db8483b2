// must not: reads a file by ..
// says: outside the folder of its scene
//@SQUARE@
Include "../outside/secret.geo";
