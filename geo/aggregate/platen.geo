// Platen on the square of concrete, of quadrilaterals.
//
//     top
//   +-----+
//   |     |  rows      x = 0 at its left, y = size of the square at its bottom
//   +-----+
//    bottom, edges
//
// Physical groups: bottom, top (curves), body (surface).

DefineConstant[ size   = {0.1, Name "Width, and height of its bottom [m]"} ];
DefineConstant[ height = {0.02, Name "Height [m]"} ];
DefineConstant[ edges  = {20, Name "Edges along the width"} ];
DefineConstant[ rows   = {2, Name "Edges along the height"} ];

Point(1) = {0, size, 0};
Point(2) = {size, size, 0};
Point(3) = {size, size + height, 0};
Point(4) = {0, size + height, 0};
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

Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Surface("body") = {1};
