// must not: writes a mesh outside
//@SQUARE@
Mesh 2;
Save "@OUTSIDE@/mark.msh";
