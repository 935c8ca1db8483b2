// must not: asks for 1e9 edges
//@SQUARE@
Transfinite Curve {1, 3} = 1000000001;
Mesh 1;
