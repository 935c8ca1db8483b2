// must not: runs a command
// says: SystemCall
//@SQUARE@
SystemCall "touch @OUTSIDE@/mark";
