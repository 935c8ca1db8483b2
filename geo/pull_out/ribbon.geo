// Ribbon pulled out of a block, its lower half: quadrilaterals, unmatched with those of the block.
//
//                      middle = plane of symmetry
//    height +------------+------------+------------+  >
//     left  |            |    body    |            |  >  pull on right, rows
//   y = 0   +------------+------------+------------+  >
//                bottom = side B of the bond, edges
//         x = 0                                  length
//
// Physical groups: bottom, middle, left, right (curves), body (surface).

DefineConstant[ length = {190, Name "Length of the bond [mm]"} ];
DefineConstant[ height = {0.165, Name "Half of the thickness [mm]"} ];
DefineConstant[ edges  = {190, Name "Edges along the bond"} ];
DefineConstant[ rows   = {1, Name "Rows of elements over the height"} ];

Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, height, 0};
Point(4) = {0, height, 0};

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
Physical Curve("middle") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
