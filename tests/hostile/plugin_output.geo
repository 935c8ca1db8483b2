// must not: writes a table by a plugin
//@SQUARE@
View "v" { SL(0, 0, 0, 1, 0, 0){1, 2}; };
Plugin(CutParametric).OutputFile = "@OUTSIDE@/mark.txt";
Plugin(NewView).ViewTag = -1;
Plugin(MathEval).Run;
