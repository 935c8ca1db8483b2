// Notched beam, left half: triangles, fine along the ligament.
//
//   height +------------------------------------o  load
//          |                                    |
//          |            body                    |  ligament = side A of the joint, edges
//          |                                    |
//          |                                  +-+  notch
//          |                                  |
//   y = 0  o----------------------------------+ x = -width / 2
//        support, x = -span / 2                 x = 0
//
// Physical groups: support, load (points), ligament (curve), body (surface).

DefineConstant[ span   = {2.0, Name "Span [m]"} ];
DefineConstant[ height = {0.2, Name "Height [m]"} ];
DefineConstant[ notch  = {0.1, Name "Depth of the notch [m]"} ];
DefineConstant[ width  = {0.004, Name "Width of the notch [m]"} ];
DefineConstant[ edges  = {120, Name "Edges along the ligament"} ];
DefineConstant[ far    = {0.05, Name "Size of the elements at the support [m]"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

near = (height - notch) / edges;
Point(1) = {-span / 2, 0, 0, far};
Point(2) = {-width / 2, 0, 0, far / 2};
Point(3) = {-width / 2, notch, 0, near};
Point(4) = {0, notch, 0, near};
Point(5) = {0, height, 0, near};
Point(6) = {-span / 2, height, 0, far};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Transfinite Curve {4} = edges + 1;
Mesh.ElementOrder = order;

Physical Point("support") = {1};
Physical Point("load") = {5};
Physical Curve("ligament") = {4};
Physical Surface("body") = {1};
