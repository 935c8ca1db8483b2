// must not: runs a client
// says: OnelabRun
//@SQUARE@
OnelabRun("client", "touch @OUTSIDE@/mark");
