// must not: prints what the environment has
//@SQUARE@
Printf(StrCat("key ", GetEnv("SECRET_KEY")));
Error(StrCat("key ", GetEnv("SECRET_KEY")));
