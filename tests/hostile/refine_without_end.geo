// must not: refines without end
//@SQUARE@
Mesh 2;
For i In {1:20}
  RefineMesh;
EndFor
