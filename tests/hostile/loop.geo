// must not: never ends
// says: was still running
//@SQUARE@
For i In {1:1e18}
EndFor
