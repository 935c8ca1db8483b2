// Four blocks at a point: two joints at right angles cross in a square, both a little inclined.
//
//                  top
//   size  +-------------8-----------+
//         |             |           |
//         |     nw      |    ne     |      one conforming mesh: every surface becomes a
//   left  |             |       ____4      subdomain with its own nodes along the joints
//         |         ____9 ----/     |
//         2 ----/       |           |  right
//         |             |           |      quadrilaterals in sw and ne,
//         |     sw      |    se     |      triangles in se and nw
//   y = 0 +-------------6-----------+
//      corner         bottom
//         x = 0                   size
//
// Physical groups: sw, se, nw, ne (surfaces), bottom, right, top, left (curves), corner, foot (points 1, 6).

DefineConstant[ size  = {2.0, Name "Size of the square [m]"} ];
DefineConstant[ slope = {0.2, Name "Slope of the joints"} ];
DefineConstant[ edges = {6, Name "Edges along each joint"} ];

cx = 0.55 * size; // where the joints cross
cy = 0.45 * size;

Point(1) = {0, 0, 0};
Point(2) = {0, cy - slope * cx, 0};
Point(3) = {size, 0, 0};
Point(4) = {size, cy + slope * (size - cx), 0};
Point(5) = {size, size, 0};
Point(6) = {cx + slope * cy, 0, 0};
Point(7) = {0, size, 0};
Point(8) = {cx - slope * (size - cy), size, 0};
Point(9) = {cx, cy, 0};

Line(1) = {1, 6};
Line(2) = {6, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 8};
Line(6) = {8, 7};
Line(7) = {7, 2};
Line(8) = {2, 1};
Line(9) = {2, 9};
Line(10) = {9, 4};
Line(11) = {6, 9};
Line(12) = {9, 8};

Curve Loop(1) = {1, 11, -9, 8};
Curve Loop(2) = {2, 3, -10, -11};
Curve Loop(3) = {9, 12, 6, 7};
Curve Loop(4) = {10, 4, 5, -12};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};

Transfinite Curve {1 : 12} = edges + 1;
Transfinite Surface {1};
Transfinite Surface {4};
Recombine Surface {1, 4};

Physical Point("corner") = {1};
Physical Point("foot") = {6};
Physical Curve("bottom") = {1, 2};
Physical Curve("right") = {3, 4};
Physical Curve("top") = {5, 6};
Physical Curve("left") = {7, 8};
Physical Surface("sw") = {1};
Physical Surface("se") = {2};
Physical Surface("nw") = {3};
Physical Surface("ne") = {4};
