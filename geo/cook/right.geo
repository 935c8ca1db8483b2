// Cook's membrane with a cut, right part, in quadratic quadrilaterals (Q8).
//
//                  _ 4
//        upper _ /   |
//    3 _ /           5 tip   from x = 24 to 48, y from 44 x/48 to 44 + x/3
//    |      body     | right
//    |            _  2
//    left     _ /            left = side B of the cut, edges
//    |    _ /   lower
//    1  /
//
// Physical groups: tip (point 5), lower, right, upper, left (curves), body (surface).

DefineConstant[ edges = {40, Name "Edges along the cut, an even number"} ];
DefineConstant[ rows  = {20, Name "Elements from left to right"} ];
DefineConstant[ order     = {2, Name "Order of the elements, 1 or 2"} ];
DefineConstant[ triangles = {0, Name "Triangles, 1, or quadrilaterals, 0"} ];

Point(1) = {24, 22, 0};
Point(2) = {48, 44, 0};
Point(3) = {24, 52, 0};
Point(4) = {48, 60, 0};
Point(5) = {48, 52, 0}; // half-way between 2 and 4

Line(1) = {1, 2};
Line(2) = {2, 5};
Line(3) = {4, 3};
Line(4) = {3, 1};
Line(5) = {5, 4};
Curve Loop(1) = {1, 2, 5, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {4} = edges + 1;
Transfinite Curve {2, 5} = edges / 2 + 1;
Transfinite Curve {1, 3} = rows + 1;
Transfinite Surface {1} = {1, 2, 4, 3};
If (!triangles)
  Recombine Surface {1};
EndIf
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1; // Q8

Physical Point("tip") = {5};
Physical Curve("lower") = {1};
Physical Curve("right") = {2, 5};
Physical Curve("upper") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
