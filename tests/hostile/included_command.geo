// must not: runs a command from a file that it includes
// says: SystemCall
//@SQUARE@
Include "inside/command.geo";
