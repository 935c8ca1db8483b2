// Inclusion in a plate: a disc in quadratic triangles with curved edges.
//
//             3
//         .---+---.
//       /           \        rim = side A of the joint, edges on the whole circle
//      |             |
//    4 +      1      + 2     body; 1 is the centre, x = y = 0
//      |             |
//       \           /
//         '---+---'
//             5
//
// Physical groups: rim (curve), body (surface).

DefineConstant[ radius = {1.0, Name "Radius [m]"} ];
DefineConstant[ edges  = {24, Name "Edges along the joint, a multiple of four"} ];

size = 2 * Pi * radius / edges;
Point(1) = {0, 0, 0, size};
Point(2) = {radius, 0, 0, size};
Point(3) = {0, radius, 0, size};
Point(4) = {-radius, 0, 0, size};
Point(5) = {0, -radius, 0, size};

Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {1, 2, 3, 4} = edges / 4 + 1;
Mesh.ElementOrder = 2;

Physical Curve("rim") = {1, 2, 3, 4};
Physical Surface("body") = {1};
