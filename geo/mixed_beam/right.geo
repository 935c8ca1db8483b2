// Beam with an eccentric notch, right of the crack: triangles, unmatched with those on its left along its way.
//
//                  load, x = length / 2
//     11 +---------o------------------------+ depth
//       /                                   |
//      /  path = side B of the joint        |
//     /   edges: path.geo                   |
//   1 +-            body                    |
//       |  notch                            |
//       +----o------------------------o-----+  y = 0
//            mouth, gauge / 2         support
//            beside the notch
//
// Physical groups: support, load, mouth (points), path (curve), body (surface).

DefineConstant[ length  = {250, Name "Length [mm]"} ];
DefineConstant[ depth   = {80, Name "Depth [mm]"} ];
DefineConstant[ support = {225, Name "Place of the support [mm]"} ];
DefineConstant[ width   = {2, Name "Width of the notch [mm]"} ];
DefineConstant[ gauge   = {20, Name "Distance of the points between which the mouth is measured [mm]"} ];
DefineConstant[ edges   = {5, Name "Edges along each of the ten pieces of the way"} ];
DefineConstant[ far     = {10, Name "Size of the elements at the end [mm]"} ];
DefineConstant[ order   = {2, Name "Order of the elements, 1 or 2"} ];

near = 6 / edges;
Include "path.geo";
tip[] = Point{1};
Point(21) = {tip[0] + width / 2, tip[1], 0, near};
Point(22) = {tip[0] + width / 2, 0, 0, far / 4};
Point(23) = {tip[0] + gauge / 2, 0, 0, far / 4};
Point(24) = {support, 0, 0, far / 4};
Point(25) = {length, 0, 0, far};
Point(26) = {length, depth, 0, far};
Point(27) = {length / 2, depth, 0, far / 4};
Line(21) = {1, 21};
Line(22) = {21, 22};
Line(23) = {22, 23};
Line(24) = {23, 24};
Line(25) = {24, 25};
Line(26) = {25, 26};
Line(27) = {26, 27};
Line(28) = {27, 11};
Curve Loop(1) = {21, 22, 23, 24, 25, 26, 27, 28, -10 : -1};
Plane Surface(1) = {1};
Transfinite Curve {1 : 10} = edges + 1;
Mesh.ElementOrder = order;

Physical Point("support") = {24};
Physical Point("load") = {27};
Physical Point("mouth") = {23};
Physical Curve("path") = {1 : 10};
Physical Surface("body") = {1};
