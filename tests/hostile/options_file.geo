// must not: runs a command from options beside it
// says: SystemCall
//@SQUARE@
// with lower.geo.opt, which the test puts there
