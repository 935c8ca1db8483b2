// must not: reads without end
//@SQUARE@
Include "/dev/zero";
