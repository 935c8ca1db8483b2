// Cook's membrane with a cut, left part, in quadratic quadrilaterals (Q8).
//
//                  _ 4
//        upper _ /   |
//    3 _ /           |       from x = 0 to 24, y from 44 x/48 to 44 + x/3
//    |      body     | right = side A of the cut, edges
//    |               |
//    left         _  2
//    |        _ /
//    |    _ /   lower
//    1  /
//
// Physical groups: lower, right, upper, left (curves), body (surface).

DefineConstant[ edges = {24, Name "Edges along the cut"} ];
DefineConstant[ rows  = {12, Name "Elements from left to right"} ];
DefineConstant[ order     = {2, Name "Order of the elements, 1 or 2"} ];
DefineConstant[ triangles = {0, Name "Triangles, 1, or quadrilaterals, 0"} ];

Point(1) = {0, 0, 0};
Point(2) = {24, 22, 0};
Point(3) = {0, 44, 0};
Point(4) = {24, 52, 0};

Line(1) = {1, 2};
Line(2) = {2, 4};
Line(3) = {4, 3};
Line(4) = {3, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {2, 4} = edges + 1;
Transfinite Curve {1, 3} = rows + 1;
Transfinite Surface {1};
If (!triangles)
  Recombine Surface {1};
EndIf
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1; // Q8

Physical Curve("lower") = {1};
Physical Curve("right") = {2};
Physical Curve("upper") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
