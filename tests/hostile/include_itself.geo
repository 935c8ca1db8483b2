// must not: includes itself without end
//@SQUARE@
Include "lower.geo";
