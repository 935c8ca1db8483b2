// must not: has its temporary files elsewhere
//@SQUARE@
General.TmpFileName = "@OUTSIDE@/mark";
General.DefaultFileName = "@OUTSIDE@/mark.geo";
General.BackgroundImageFileName = "@OUTSIDE@/victim.txt";
