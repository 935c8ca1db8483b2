Point(1)={.5,1,0,.2};Point(2)={1.5,1,0,.2};Point(3)={1.5,2,0,.2};Point(4)={.5,2,0,.2};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1:4};Plane Surface(1)={1};
Physical Curve("bottom")={1};Physical Curve("top")={3};Physical Surface("body")={1};
