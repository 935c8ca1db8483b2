// Two rings, outer one: as the inner one, with other edges along the joint.
//
//            y
//            |  left
//    outside +--_
//            |    -_   outer
//     inside +-_    \
//               \    \      inner = side B of the joint, edges
//                |    |     r = inside
//                +----+-- x
//                 bottom
//
// Physical groups: inner, outer, left, bottom (curves), body (surface).

DefineConstant[ inside  = {1.5, Name "Inner radius [m]"} ];
DefineConstant[ outside = {2.0, Name "Outer radius [m]"} ];
DefineConstant[ edges   = {9, Name "Edges along the joint"} ];
DefineConstant[ rows    = {2, Name "Rows of elements"} ];
DefineConstant[ order     = {2, Name "Order of the elements, 1 or 2"} ];
DefineConstant[ triangles = {0, Name "Triangles, 1, or quadrilaterals, 0"} ];

Point(1) = {0, 0, 0};
Point(2) = {inside, 0, 0};
Point(3) = {outside, 0, 0};
Point(4) = {0, outside, 0};
Point(5) = {0, inside, 0};

Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
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

Physical Curve("bottom") = {1};
Physical Curve("outer") = {2};
Physical Curve("left") = {3};
Physical Curve("inner") = {4};
Physical Surface("body") = {1};
