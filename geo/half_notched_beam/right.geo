// Half-notched beam, right half: triangles, unmatched with those of the left half along the ligament.
//
//   load  o---------------------------------+ depth
//         |                                 |
//         |  ligament = side B of the joint |
//         |  edges           body           |
//   notch +-+                               |
//           |                               |
//           +-------o-----------------o-----+  y = 0
//   x = width / 2   mouth,                x = length / 2
//                   x = gauge / 2     support, x = span / 2
//
// Physical groups: support, load, mouth (points), ligament (curve), body (surface).

DefineConstant[ length = {175, Name "Length [mm]"} ];
DefineConstant[ span   = {125, Name "Span [mm]"} ];
DefineConstant[ depth  = {50, Name "Depth [mm]"} ];
DefineConstant[ notch  = {25, Name "Depth of the notch [mm]"} ];
DefineConstant[ width  = {2, Name "Width of the notch [mm]"} ];
DefineConstant[ gauge  = {20, Name "Distance of the points between which the mouth is measured [mm]"} ];
DefineConstant[ edges  = {40, Name "Edges along the ligament"} ];
DefineConstant[ far    = {8, Name "Size of the elements at the end [mm]"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

near = (depth - notch) / edges;
Point(1) = {width / 2, 0, 0, far / 4};
Point(2) = {gauge / 2, 0, 0, far / 4};
Point(3) = {span / 2, 0, 0, far / 4};
Point(4) = {length / 2, 0, 0, far};
Point(5) = {length / 2, depth, 0, far};
Point(6) = {0, depth, 0, near};
Point(7) = {0, notch, 0, near};
Point(8) = {width / 2, notch, 0, near};
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

Physical Point("support") = {3};
Physical Point("load") = {6};
Physical Point("mouth") = {2};
Physical Curve("ligament") = {6};
Physical Surface("body") = {1};
