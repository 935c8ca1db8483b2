// must not: has its mesh written elsewhere
//@SQUARE@
Mesh.Format = 39;
General.FileName = "@OUTSIDE@/mark.inp";
Mesh 2;
Save "@OUTSIDE@/mark.inp";
Exit;
