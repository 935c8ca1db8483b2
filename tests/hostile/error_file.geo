// must not: has its errors written outside
//@SQUARE@
General.ErrorFileName = "@OUTSIDE@/mark.txt";
Save Options "@OUTSIDE@/mark.opt";
nothing = is + right;
