// must not: has its options written over those of the user
//@SQUARE@
General.OptionsFileName = "@OUTSIDE@/victim.txt";
General.SaveOptions = 2;
General.SaveSession = 1;
General.SessionFileName = "@OUTSIDE@/mark.txt";
