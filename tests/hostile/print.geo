// must not: writes a picture outside
//@SQUARE@
Print "@OUTSIDE@/mark.pos";
