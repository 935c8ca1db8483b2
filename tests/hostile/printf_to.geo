// must not: writes a text outside
//@SQUARE@
Printf("gone") > "@OUTSIDE@/victim.txt";
