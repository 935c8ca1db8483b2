// Inclined crack: a plate so wide that its crack takes it for an infinite plane, in quadratic triangles.
//
//      4                            3
//      +------------top-------------+
//      |     13 +----------+ 12     |      crack 5-6-7, drawn inside the plate, at an angle to the x axis;
//      |        |       .+-+ 10     |      x = y = 0 in its middle, 6
//    left west 14  6 +' 7  + 11 east right
//      |      8 +-+'       |        |      length: from the middle of the crack to an end
//      |        |  5       |        |      side: half of the plate's width
//      |      9 +----------+ 15     |      box 8 … 15: half of its width is twice length; for the mesh only,
//      +-----------bottom-----------+           and to hold the plate at 11 and 14, y = 0, where it pushes nothing
//      1                            2
//
// Physical groups: crack, left, right (curves), west, east (points), body (surface).

DefineConstant[ length = {1.0, Name "Half of the crack's length [m]"} ];
DefineConstant[ angle  = {20, Name "Angle of the crack to the x axis, between 0 and 45 [degrees]"} ];
DefineConstant[ side   = {100.0, Name "Half of the width [m]"} ];
DefineConstant[ tip    = {0.002, Name "Size of the elements at the ends of the crack [m]"} ];
DefineConstant[ middle = {0.04, Name "Size of the elements in the middle of the crack [m]"} ];
DefineConstant[ around = {0.2, Name "Size of the elements on the box [m]"} ];
DefineConstant[ coarse = {10.0, Name "Size of the elements at the sides [m]"} ];

x = length * Cos(angle * Pi / 180);
y = length * Sin(angle * Pi / 180);
box = 2 * length;
rise = box * Tan(angle * Pi / 180);
Point(1) = {-side, -side, 0, coarse};
Point(2) = {side, -side, 0, coarse};
Point(3) = {side, side, 0, coarse};
Point(4) = {-side, side, 0, coarse};
Point(5) = {-x, -y, 0, tip};
Point(6) = {0, 0, 0, middle};
Point(7) = {x, y, 0, tip};
Point(8) = {-box, -rise, 0, around};
Point(9) = {-box, -box, 0, around};
Point(10) = {box, rise, 0, around};
Point(11) = {box, 0, 0, around};
Point(12) = {box, box, 0, around};
Point(13) = {-box, box, 0, around};
Point(14) = {-box, 0, 0, around};
Point(15) = {box, -box, 0, around};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {8, 5};
Line(8) = {7, 10};
Line(9) = {10, 12};
Line(10) = {12, 13};
Line(11) = {13, 14};
Line(12) = {14, 8};
Line(13) = {8, 9};
Line(14) = {9, 15};
Line(15) = {15, 11};
Line(16) = {11, 10};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {9, 10, 11, 12, 13, 14, 15, 16};
Curve Loop(3) = {7, 5, 6, 8, 9, 10, 11, 12};
Curve Loop(4) = {13, 14, 15, 16, -8, -6, -5, -7};
Plane Surface(1) = {1, 2};
Plane Surface(2) = {3};
Plane Surface(3) = {4};

Mesh.ElementOrder = 2;

Physical Point("west") = {14};
Physical Point("east") = {11};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
Physical Curve("crack") = {5, 6};
Physical Surface("body") = {1, 2, 3};
