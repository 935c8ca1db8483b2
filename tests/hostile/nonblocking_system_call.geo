// must not: leaves a process behind
// says: NonBlockingSystemCall
//@SQUARE@
NonBlockingSystemCall "sleep 300";
