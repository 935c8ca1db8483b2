// Half-notched beam, left half: triangles, fine along the ligament.
//
//   depth +---------------------------------o  load
//         |                                 |
//         |            body                 |  ligament = side A of the joint, edges
//         |                                 |
//         |                               +-+  notch
//         |                               |
//   y = 0 +-----o-----------------o-------+ x = -width / 2
//     x = -length / 2             mouth, x = -gauge / 2
//           support, x = -span / 2
//
// Physical groups: support, load, mouth (points), ligament (curve), body (surface).

DefineConstant[ length = {175, Name "Length [mm]"} ];
DefineConstant[ span   = {125, Name "Span [mm]"} ];
DefineConstant[ depth  = {50, Name "Depth [mm]"} ];
DefineConstant[ notch  = {25, Name "Depth of the notch [mm]"} ];
DefineConstant[ width  = {2, Name "Width of the notch [mm]"} ];
DefineConstant[ gauge  = {20, Name "Distance of the points between which the mouth is measured [mm]"} ];
DefineConstant[ edges  = {50, Name "Edges along the ligament"} ];
DefineConstant[ far    = {8, Name "Size of the elements at the end [mm]"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

near = (depth - notch) / edges;
Point(1) = {-length / 2, 0, 0, far};
Point(2) = {-span / 2, 0, 0, far / 4};
Point(3) = {-gauge / 2, 0, 0, far / 4};
Point(4) = {-width / 2, 0, 0, far / 4};
Point(5) = {-width / 2, notch, 0, near};
Point(6) = {0, notch, 0, near};
Point(7) = {0, depth, 0, near};
Point(8) = {-length / 2, depth, 0, far};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};
Transfinite Curve {6} = edges + 1;
Mesh.ElementOrder = order;

Physical Point("support") = {2};
Physical Point("load") = {7};
Physical Point("mouth") = {3};
Physical Curve("ligament") = {6};
Physical Surface("body") = {1};
