// must not: runs a command from a file whose name is computed
//@SQUARE@
Include StrCat("inside/", "command", ".geo");
