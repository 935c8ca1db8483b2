// must not: writes a view outside
//@SQUARE@
View "v" { SP(0, 0, 0){1}; };
Save View[0] "@OUTSIDE@/mark.pos";
