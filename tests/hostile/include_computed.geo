// must not: reads a file whose name is computed
//@SQUARE@
Include StrCat("../out", "side/secret.geo");
Include StrCat("@OUTSIDE@/", "secret.geo");
