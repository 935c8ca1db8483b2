// Plate with a hole for the inclusion, in quadratic triangles with curved edges.
//
//      9                 8
//      +--------top------+
//      |      .-3-.      |
//      |    /       \    |     hole = side B of the joint, edges on the whole circle
//    left  4    1    2 right   x = y = 0 in its centre, 1
//      |    \       /    |     side: half of the plate's width
//      |      '-5-'      |
//      +------bottom-----+
//      6                 7
//
// Physical groups: hole, left, right, top, bottom (curves), corner (point 6), body (surface).

DefineConstant[ radius = {1.0, Name "Radius of the hole [m]"} ];
DefineConstant[ side   = {8.0, Name "Half of the width [m]"} ];
DefineConstant[ edges  = {36, Name "Edges along the joint, a multiple of four"} ];
DefineConstant[ coarse = {1.6, Name "Size of the elements at the sides [m]"} ];

size = 2 * Pi * radius / edges;
Point(1) = {0, 0, 0, size};
Point(2) = {radius, 0, 0, size};
Point(3) = {0, radius, 0, size};
Point(4) = {-radius, 0, 0, size};
Point(5) = {0, -radius, 0, size};
Point(6) = {-side, -side, 0, coarse};
Point(7) = {side, -side, 0, coarse};
Point(8) = {side, side, 0, coarse};
Point(9) = {-side, side, 0, coarse};

Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 9};
Line(8) = {9, 6};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {2, 1};

Transfinite Curve {1, 2, 3, 4} = edges / 4 + 1;
Mesh.ElementOrder = 2;

Physical Point("corner") = {6};
Physical Curve("hole") = {1, 2, 3, 4};
Physical Curve("bottom") = {5};
Physical Curve("right") = {6};
Physical Curve("top") = {7};
Physical Curve("left") = {8};
Physical Surface("body") = {1};
