// must not: writes a mesh by ..
//@SQUARE@
Mesh 2;
Save "../outside/mark.msh";
Save "../../../../outside/mark.msh";
