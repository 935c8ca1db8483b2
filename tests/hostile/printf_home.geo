// must not: adds to a file of the user
//@SQUARE@
Printf("gone") >> StrCat(GetEnv("HOME"), "/.profile");
Printf("gone") >> "@OUTSIDE@/home/.profile";
