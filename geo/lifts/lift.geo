// One lift of a wall: quadratic quadrilaterals.
//
//   from + height +----------------+  top
//                 |      body      |  rows
//          from   +----------------+  bottom, edges
//              x = -width / 2      width / 2
//
// Physical groups: bottom, right, top, left (curves), body (surface).

DefineConstant[ width  = {8.0, Name "Width of the wall [m]"} ];
DefineConstant[ from   = {0.0, Name "Height of the bottom [m]"} ];
DefineConstant[ height = {2.0, Name "Height of the lift [m]"} ];
DefineConstant[ edges  = {16, Name "Edges along the bottom"} ];
DefineConstant[ rows   = {4, Name "Rows of elements"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

Point(1) = {-width / 2, from, 0};
Point(2) = {width / 2, from, 0};
Point(3) = {width / 2, from + height, 0};
Point(4) = {-width / 2, from + height, 0};
For k In {1:4}
  Line(k) = {k, k % 4 + 1};
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = edges + 1;
Transfinite Curve {2, 4} = rows + 1;
Transfinite Surface {1};
Recombine Surface {1};
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
