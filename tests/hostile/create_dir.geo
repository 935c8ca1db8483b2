// must not: makes a folder outside
//@SQUARE@
CreateDir "@OUTSIDE@/mark";
