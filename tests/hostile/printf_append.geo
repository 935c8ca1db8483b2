// must not: adds to a file outside
//@SQUARE@
Printf("gone") >> "@OUTSIDE@/victim.txt";
