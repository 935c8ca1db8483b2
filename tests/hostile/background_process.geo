// must not: leaves a process behind that has a group of its own
// says: SystemCall
//@SQUARE@
SystemCall "setsid sleep 300 &";
