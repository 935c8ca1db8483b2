// Rock under the dam, a block of 180 m by 80 m.
//
//      floor    base
//     ._______.______.______.
//     |       0      60     |     base, `edges` edges
//     |                     | sides
//     |_____________________|
//             bottom
//
// Physical groups: base, floor (of the reservoir), sides, bottom (curves), rock (surface).

DefineConstant[ edges = {40, Name "Edges along the base"} ];
DefineConstant[ size  = {16, Name "Edges far away [m]"} ];
DefineConstant[ order = {2, Name "Order of the elements, 1 or 2"} ];

h = 60 / edges;
Point(1) = {-60, -80, 0, size};
Point(2) = {120, -80, 0, size};
Point(3) = {120, 0, 0, size};
Point(4) = {60, 0, 0, h};
Point(5) = {0, 0, 0, h};
Point(6) = {-60, 0, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
Transfinite Curve {4} = edges + 1;

Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 6};
Physical Curve("base") = {4};
Physical Curve("floor") = {5};
Physical Surface("rock") = {1};
Mesh.ElementOrder = order;
