// must not: prints without end
//@SQUARE@
For i In {1:1e12}
  Printf("a line that is repeated without end, and then repeated again, and again, and again");
EndFor
