// must not: removes a file
//@SQUARE@
Delete "@OUTSIDE@/victim.txt";
