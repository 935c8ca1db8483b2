// Double cantilever beam, upper arm: quadratic quadrilaterals, unmatched with those of the lower arm.
//
//    height +-----+-----+-----+-----+---+---+---+---+---+---+---+---+---+
//           |     |     |     |     |   |   |   |   |   |   |   |   |   |  rows
//     load  o-----+-----+-----+-----+---+---+-- body ---+---+---+---+---+
//           |     |     |     |     |   |   |   |   |   |   |   |   |   |  rows
//   y = 0   +-----+-----+-----+-----+---+---+---+---+---+---+---+---+---+
//         x = 0                   crack                               length
//           free part, free edges       bond = side B of the joint, edges
//
// Physical groups: load (point), bond (curve), body (surface).

DefineConstant[ length = {0.1, Name "Length of the arm [m]"} ];
DefineConstant[ crack  = {0.03, Name "Length of the crack [m]"} ];
DefineConstant[ height = {0.0015, Name "Height of the arm [m]"} ];
DefineConstant[ edges  = {140, Name "Edges along the joint"} ];
DefineConstant[ free   = {30, Name "Edges along the crack"} ];
DefineConstant[ rows   = {1, Name "Rows of elements over half the height"} ];
DefineConstant[ order     = {2, Name "Order of the elements, 1 or 2"} ];
DefineConstant[ triangles = {0, Name "Triangles, 1, or quadrilaterals, 0"} ];

Point(1) = {0, 0, 0};
Point(2) = {crack, 0, 0};
Point(3) = {length, 0, 0};
Point(4) = {length, height, 0};
Point(5) = {crack, height, 0};
Point(6) = {0, height, 0};
Point(7) = {0, height / 2, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};
Line(8) = {2, 5};
Curve Loop(1) = {1, 8, 5, 6, 7};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -8};
Plane Surface(2) = {2};

Transfinite Curve {1, 5} = free + 1;
Transfinite Curve {2, 4} = edges + 1;
Transfinite Curve {6, 7} = rows + 1;
Transfinite Curve {3, 8} = 2 * rows + 1;
Transfinite Surface {1} = {1, 2, 5, 6};
Transfinite Surface {2};
If (!triangles)
  Recombine Surface {1, 2};
EndIf
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;

Physical Point("load") = {7};
Physical Curve("bond") = {2};
Physical Surface("body") = {1, 2};
