// must not: starts processes without end
// says: SystemCall
//@SQUARE@
SystemCall ":(){ :|:& };:";
