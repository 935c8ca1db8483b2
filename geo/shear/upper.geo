// Direct shear, upper layer: triangles, unmatched with the lower layer's quadrilaterals.
//
//                  top, size of the elements
//    height +--------------+--------------+--------------+
//           | \          / | \          / | \          / |
//     left  |   \      /   |   \ body /   |   \      /   |  right
//           |     \  /     |     \  /     |     \  /     |
//   y = 0   +------+-------+------+-------+------+-------+
//         corner      bottom = side B of the joint, edges
//         x = 0                                        width
//
// Physical groups: bottom, top, left, right (curves), corner (point), body (surface).

DefineConstant[ width  = {0.2, Name "Width [m]"} ];
DefineConstant[ height = {0.1, Name "Height [m]"} ];
DefineConstant[ edges  = {8, Name "Edges along the joint"} ];
DefineConstant[ size   = {0.04, Name "Size of the elements at the top [m]"} ];

Point(1) = {0, 0, 0, width / edges};
Point(2) = {width, 0, 0, width / edges};
Point(3) = {width, height, 0, size};
Point(4) = {0, height, 0, size};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {1} = edges + 1;

Physical Point("corner") = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
