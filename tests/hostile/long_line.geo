// must not: has a line of a megabyte
//@SQUARE@
x = "@LONG@";
nothing = is + @LONG@;
