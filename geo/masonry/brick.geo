// One brick: x, y its lower left corner. Quadratic quadrilaterals.
//
//        top
//     +-------+
//     | body  |  rows      left, right: head joints
//     +-------+
//      bottom, edges
//
// Physical groups: bottom, right, top, left (curves), body (surface).

DefineConstant[ x      = {0, Name "Left [m]"} ];
DefineConstant[ y      = {0, Name "Bottom [m]"} ];
DefineConstant[ width  = {0.22, Name "Width [m]"} ];
DefineConstant[ height = {0.062, Name "Height [m]"} ];
DefineConstant[ edges  = {8, Name "Edges along the width"} ];
DefineConstant[ rows   = {3, Name "Edges along the height"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

Point(1) = {x, y, 0};
Point(2) = {x + width, y, 0};
Point(3) = {x + width, y + height, 0};
Point(4) = {x, y + height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
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
