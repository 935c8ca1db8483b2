// must not: takes all memory
//@SQUARE@
s = 0; t = "0123456789abcdef";
For i In {1:60}
  t = StrCat(t, t);
EndFor
