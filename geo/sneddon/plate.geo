// Sneddon's crack: a plate so wide that its crack takes it for an infinite plane, in quadratic triangles.
//
//      4                            3
//      +----------------------------+
//      |     11 +----------+ 10     |      crack 5-6-7, drawn inside the plate along the x axis;
//      |        |          |        |      x = y = 0 in its middle, 6
//      |  west  8--+--+--+-9  east  |
//      |        |  5  6  7 |        |      length: from the middle of the crack to an end
//      |        |          |        |      side: half of the plate's width
//      |     12 +----------+ 13     |      box 8 … 13: half of its width is twice length; for the mesh only,
//      +----------------------------+           and to hold the plate at 8 and 9
//      1                            2
//
// Physical groups: crack (curve), west, east (points), body (surface).

DefineConstant[ length = {1.0, Name "Half of the crack's length [m]"} ];
DefineConstant[ side   = {100.0, Name "Half of the width [m]"} ];
DefineConstant[ tip    = {0.002, Name "Size of the elements at the ends of the crack [m]"} ];
DefineConstant[ middle = {0.04, Name "Size of the elements in the middle of the crack [m]"} ];
DefineConstant[ around = {0.2, Name "Size of the elements on the box [m]"} ];
DefineConstant[ coarse = {10.0, Name "Size of the elements at the sides [m]"} ];

box = 2 * length;
Point(1) = {-side, -side, 0, coarse};
Point(2) = {side, -side, 0, coarse};
Point(3) = {side, side, 0, coarse};
Point(4) = {-side, side, 0, coarse};
Point(5) = {-length, 0, 0, tip};
Point(6) = {0, 0, 0, middle};
Point(7) = {length, 0, 0, tip};
Point(8) = {-box, 0, 0, around};
Point(9) = {box, 0, 0, around};
Point(10) = {box, box, 0, around};
Point(11) = {-box, box, 0, around};
Point(12) = {-box, -box, 0, around};
Point(13) = {box, -box, 0, around};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {8, 5};
Line(8) = {7, 9};
Line(9) = {9, 10};
Line(10) = {10, 11};
Line(11) = {11, 8};
Line(12) = {8, 12};
Line(13) = {12, 13};
Line(14) = {13, 9};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {9, 10, 11, 12, 13, 14};
Curve Loop(3) = {7, 5, 6, 8, 9, 10, 11};
Curve Loop(4) = {12, 13, 14, -8, -6, -5, -7};
Plane Surface(1) = {1, 2};
Plane Surface(2) = {3};
Plane Surface(3) = {4};

Mesh.ElementOrder = 2;

Physical Point("west") = {8};
Physical Point("east") = {9};
Physical Curve("crack") = {5, 6};
Physical Surface("body") = {1, 2, 3};
