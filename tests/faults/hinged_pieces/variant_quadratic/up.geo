Point(1)={0,0,0,.3};Point(2)={2,0,0,.3};Point(3)={2,.5,0,.3};Point(4)={1,.5,0,.3};Point(5)={0,.5,0,.3};Point(6)={1.5,1,0,.3};Point(7)={.5,1,0,.3};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,5};Line(5)={5,1};Line(6)={4,6};Line(7)={6,7};Line(8)={7,4};
Curve Loop(1)={1:5};Plane Surface(1)={1};Curve Loop(2)={6,7,8};Plane Surface(2)={2};
Physical Curve("bottom")={1};Physical Curve("top")={7};Physical Surface("body")={1,2};
Mesh.ElementOrder = 2;
