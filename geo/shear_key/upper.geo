// Shear key, upper part: a groove in its bottom takes the key of the lower part.
//
//                          top
//    height +----------------------------------+
//           |                                  |
//     left  |               body               |  right
//           |              ______              |
//           |             /      \             |
//   y = 0   +------------+        +------------+
//                  bottom = side B of the joint
//         x = 0                            length
//
// Physical groups: bottom, right, top, left (curves), body (surface).

DefineConstant[ length = {1.2, Name "Length [m]"} ];
DefineConstant[ height = {0.4, Name "Height [m]"} ];
DefineConstant[ key    = {0.1, Name "Depth of the groove [m]"} ];
DefineConstant[ crown  = {0.2, Name "Width of the groove at its crown [m]"} ];
DefineConstant[ flank  = {0.05, Name "Width of each flank [m]"} ];
DefineConstant[ size   = {0.017, Name "Size of the elements at the joint [m]"} ];

middle = length / 2;

Point(1) = {0, 0, 0, size};
Point(2) = {middle - crown / 2 - flank, 0, 0, size};
Point(3) = {middle - crown / 2, key, 0, size};
Point(4) = {middle + crown / 2, key, 0, size};
Point(5) = {middle + crown / 2 + flank, 0, 0, size};
Point(6) = {length, 0, 0, size};
Point(7) = {length, height, 0, 2 * size};
Point(8) = {0, height, 0, 2 * size};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Curve Loop(1) = {1 : 8};
Plane Surface(1) = {1};

Physical Curve("bottom") = {1 : 5};
Physical Curve("right") = {6};
Physical Curve("top") = {7};
Physical Curve("left") = {8};
Physical Surface("body") = {1};
