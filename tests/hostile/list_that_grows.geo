// must not: takes all memory
//@SQUARE@
l() = {0:1e12};
