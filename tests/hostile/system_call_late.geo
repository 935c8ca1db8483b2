// must not: runs a command after the mesh is made
// says: SystemCall
//@SQUARE@
Mesh 2;
SystemCall Sprintf("touch @OUTSIDE@/mark%g", 1);
