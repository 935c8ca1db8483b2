// The ground that is dug out: a disc, its edges those of the wall around it.
//
// Physical groups: rim (curve), body (surface).

DefineConstant[ radius = {4.7, Name "Radius of the tunnel [m]"} ];
DefineConstant[ edges  = {24, Name "Edges along a quarter of the rim"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

size = radius * Pi / 2 / edges;
Point(1) = {0, 0, 0, 2 * size};
For k In {0:3}
  Point(10 + k) = {radius * Cos(k * Pi / 2), radius * Sin(k * Pi / 2), 0, size};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1) % 4};
EndFor
Curve Loop(1) = {10:13};
Plane Surface(1) = {1};
Transfinite Curve {10:13} = edges + 1;
Mesh.ElementOrder = order;

Physical Curve("rim") = {10:13};
Physical Surface("body") = {1};
