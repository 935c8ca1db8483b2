// must not: names a program as a solver
//@SQUARE@
Solver.Executable0 = "touch @OUTSIDE@/mark";
Solver.AutoMesh = 2;
