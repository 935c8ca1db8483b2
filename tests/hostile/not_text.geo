// must not: is no text
//@SQUARE@
ÿþ€ = 1;
