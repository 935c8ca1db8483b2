// must not: calls itself without end
//@SQUARE@
Macro again
  Call again;
Return
Call again;
