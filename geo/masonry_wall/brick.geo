// One brick, a half one, or a beam as long as the wall: x, y its lower left corner. Quadratic quadrilaterals.
//
//          top
//     +-----+-----+
//     |     |     |  rows      left, right: head joints
//     +-----+-----+            middle: where a brick may crack
//      edges, edges
//         bottom
//
// Physical groups: bottom, right, top, left, middle (curves), body (surface).

DefineConstant[ x      = {0, Name "Left [m]"} ];
DefineConstant[ y      = {0, Name "Bottom [m]"} ];
DefineConstant[ width  = {0.22, Name "Width [m]"} ];
DefineConstant[ height = {0.062, Name "Height [m]"} ];
DefineConstant[ edges  = {2, Name "Edges along each half of the width"} ];
DefineConstant[ rows   = {2, Name "Edges along the height"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

Point(1) = {x, y, 0};
Point(2) = {x + width / 2, y, 0};
Point(3) = {x + width, y, 0};
Point(4) = {x + width, y + height, 0};
Point(5) = {x + width / 2, y + height, 0};
Point(6) = {x, y + height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve {1, 2, 4, 5} = edges + 1;
Transfinite Curve {3, 6, 7} = rows + 1;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;

Physical Curve("bottom") = {1, 2};
Physical Curve("right") = {3};
Physical Curve("top") = {4, 5};
Physical Curve("left") = {6};
Physical Curve("middle") = {7};
Physical Surface("body") = {1, 2};
