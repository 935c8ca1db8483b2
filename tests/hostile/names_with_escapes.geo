// must not: has escape sequences in the names of groups
//@SQUARE@
Physical Curve("[2Jtop") = {3};
no_such([31m) = 1;
