// Rock below a wall.
//
//   y = 0 +--------+==============+--------+     base = side A of the joint, edges
//         |                                |
//         |              body              |     left and right: edges of the model
//         |                                |
//  -depth +--------------------------------+     bottom
//       x = -extent                        extent
//
// Physical groups: base, bottom, left, right, top (curves), body (surface).

DefineConstant[ width  = {8.0, Name "Width of the wall [m]"} ];
DefineConstant[ extent = {20.0, Name "Half width of the rock [m]"} ];
DefineConstant[ depth  = {16.0, Name "Depth of the rock [m]"} ];
DefineConstant[ edges  = {20, Name "Edges along the base"} ];
DefineConstant[ far    = {2.0, Name "Size of the elements at the bottom [m]"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

near = width / edges;
Point(1) = {-extent, -depth, 0, far};
Point(2) = {extent, -depth, 0, far};
Point(3) = {extent, 0, 0, far};
Point(4) = {width / 2, 0, 0, near};
Point(5) = {-width / 2, 0, 0, near};
Point(6) = {-extent, 0, 0, far};
For k In {1:6}
  Line(k) = {k, k % 6 + 1};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
Transfinite Curve {4} = edges + 1;
Mesh.ElementOrder = order;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3, 5};
Physical Curve("base") = {4};
Physical Curve("left") = {6};
Physical Surface("body") = {1};
