// Beam with an eccentric notch, left of the crack: triangles, fine along its way.
//
//   depth +----------------------+ 11
//         |                     /
//         |     body           /   path = side A of the joint, edges: path.geo
//         |                   /
//         |                 -+ 1
//         |                 |  notch
//   y = 0 +----o--------o---+
//       x = 0  support  mouth, gauge / 2 beside the notch
//
// Physical groups: support, mouth (points), path (curve), body (surface).

DefineConstant[ depth   = {80, Name "Depth [mm]"} ];
DefineConstant[ support = {25, Name "Place of the support [mm]"} ];
DefineConstant[ width   = {2, Name "Width of the notch [mm]"} ];
DefineConstant[ gauge   = {20, Name "Distance of the points between which the mouth is measured [mm]"} ];
DefineConstant[ edges   = {6, Name "Edges along each of the ten pieces of the way"} ];
DefineConstant[ far     = {10, Name "Size of the elements at the end [mm]"} ];
DefineConstant[ order   = {2, Name "Order of the elements, 1 or 2"} ];

near = 6 / edges;
Include "path.geo";
tip[] = Point{1};
Point(21) = {0, 0, 0, far};
Point(22) = {support, 0, 0, far / 4};
Point(23) = {tip[0] - gauge / 2, 0, 0, far / 4};
Point(24) = {tip[0] - width / 2, 0, 0, far / 4};
Point(25) = {tip[0] - width / 2, tip[1], 0, near};
Point(26) = {0, depth, 0, far};
Line(21) = {21, 22};
Line(22) = {22, 23};
Line(23) = {23, 24};
Line(24) = {24, 25};
Line(25) = {25, 1};
Line(26) = {11, 26};
Line(27) = {26, 21};
Curve Loop(1) = {21, 22, 23, 24, 25, 1 : 10, 26, 27};
Plane Surface(1) = {1};
Transfinite Curve {1 : 10} = edges + 1;
Mesh.ElementOrder = order;

Physical Point("support") = {22};
Physical Point("mouth") = {23};
Physical Curve("path") = {1 : 10};
Physical Surface("body") = {1};
