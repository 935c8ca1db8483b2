// Rough joint, lower layer: quadrilaterals.
//
//                     top = side A of the joint
//   y = 0   +--------+--------+--------+--------+--------+
//           |        |        |        |        |        |
//     left  +--------+--------+--------+--------+--------+  right
//           |        |        |  body  |        |        |  rows
//   -height +--------+--------+--------+--------+--------+
//         x = 0              bottom, edges              width
//
// Physical groups: bottom, top, left, right (curves), body (surface).

DefineConstant[ width  = {1.0, Name "Width [m]"} ];
DefineConstant[ height = {0.5, Name "Height [m]"} ];
DefineConstant[ edges  = {24, Name "Edges along the joint"} ];
DefineConstant[ rows   = {12, Name "Rows of elements over the height"} ];

Point(1) = {0, -height, 0};
Point(2) = {width, -height, 0};
Point(3) = {width, 0, 0};
Point(4) = {0, 0, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {1, 3} = edges + 1;
Transfinite Curve {2, 4} = rows + 1;
Transfinite Surface {1};
Recombine Surface {1};

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
