// must not: writes a mesh beside the geometry
//@SQUARE@
Mesh 2;
Save "mark.msh";
Save "@SCENE@/mark.msh";
