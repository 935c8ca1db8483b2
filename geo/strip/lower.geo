// Two-layer strip, lower layer: half a wave of the load that is harmonic in x.
//
//             top = side A of the joint, edges
//   y = 0   +--------+--------+--------+--------+
//    left   |        |  body  |        |        |  right, rows
//   -height +--------+--------+--------+--------+
//                       bottom, clamped
//         x = 0                               width
//
// Physical groups: bottom, top, left, right (curves), body (surface).

DefineConstant[ width     = {1.0, Name "Width, half a wave [m]"} ];
DefineConstant[ height    = {0.8, Name "Height [m]"} ];
DefineConstant[ edges     = {8, Name "Edges along the joint"} ];
DefineConstant[ rows      = {6, Name "Rows of elements"} ];
DefineConstant[ order     = {2, Name "Order of the elements, 1 or 2"} ];
DefineConstant[ triangles = {0, Name "Triangles, 1, or quadrilaterals, 0"} ];

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
If (!triangles)
  Recombine Surface {1};
EndIf
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1; // Q8

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
