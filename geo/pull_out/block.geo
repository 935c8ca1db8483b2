// The block in which the ribbon is bonded, rigid: quadrilaterals, all nodes held.
//
//                       top = side A of the bond
//   y = 0   +--------+--------+--------+--------+--------+
//     left  |        |        |  body  |        |        |  right, rows
//   -height +--------+--------+--------+--------+--------+
//                          bottom, edges
//         x = 0                                        length
//
// Physical groups: bottom, top, left, right (curves), body (surface).

DefineConstant[ length = {190, Name "Length of the bond [mm]"} ];
DefineConstant[ height = {10, Name "Height [mm]"} ];
DefineConstant[ edges  = {150, Name "Edges along the bond"} ];
DefineConstant[ rows   = {2, Name "Rows of elements over the height"} ];

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
