// Step block, lower part: the upper one stands on the right end of its top and hangs over.
//
//              top, of which the right part is joined
//   y = 0   +--------+--------+--------+--------+
//           |        |        |        |        |
//     left  +--------+--- body --------+--------+  right, rows
//           |        |        |        |        |
//   -height +--------+--------+--------+--------+
//                      bottom, edges
//         x = 0                             length
//
// Physical groups: bottom, right, top, left (curves), body (surface).

DefineConstant[ length = {2.0, Name "Length [m]"} ];
DefineConstant[ height = {0.8, Name "Height [m]"} ];
DefineConstant[ edges  = {20, Name "Edges along the top"} ];
DefineConstant[ rows   = {8, Name "Rows of elements over the height"} ];

Point(1) = {0, -height, 0};
Point(2) = {length, -height, 0};
Point(3) = {length, 0, 0};
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
