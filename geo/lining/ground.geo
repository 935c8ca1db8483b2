// Ground around a lined tunnel: a ring of quadratic quadrilaterals that get larger outwards, held on its outer edge.
//
//         .--------.        far = outer edge, at extent * radius
//       /     __     \
//      |    /    \    |     wall = edge of the tunnel, a side of the joints, 4 * edges
//      |    \ __ /    |
//       \            /      rows from the wall outwards
//         '--------'
//
// Physical groups: wall, far (curves), wall_side, wall_crown (points), body (surface).

DefineConstant[ radius = {4.7, Name "Radius of the tunnel [m]"} ];
DefineConstant[ extent = {12, Name "Radius of the ground over that of the tunnel"} ];
DefineConstant[ edges  = {24, Name "Edges along a quarter of the wall"} ];
DefineConstant[ rows   = {18, Name "Rows of elements outwards"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

outer = extent * radius;
Point(1) = {0, 0, 0};
For k In {0:3}
  c = Cos(k * Pi / 2); s = Sin(k * Pi / 2);
  Point(10 + k) = {radius * c, radius * s, 0};
  Point(20 + k) = {outer * c, outer * s, 0};
EndFor
For k In {0:3}
  next = (k + 1) % 4;
  Circle(10 + k) = {10 + k, 1, 10 + next};
  Circle(20 + k) = {20 + k, 1, 20 + next};
  Line(30 + k) = {10 + k, 20 + k};
EndFor
// every ring is as much wider than the one inside it
ratio = extent ^ (1 / rows);
For k In {0:3}
  next = (k + 1) % 4;
  Curve Loop(k + 1) = {30 + k, 20 + k, -(30 + next), -(10 + k)};
  Plane Surface(k + 1) = {k + 1};
  Transfinite Curve {10 + k, 20 + k} = edges + 1;
  Transfinite Curve {30 + k} = rows + 1 Using Progression ratio;
  Transfinite Surface {k + 1};
  Recombine Surface {k + 1};
EndFor
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;

Physical Point("wall_side") = {10};
Physical Point("wall_crown") = {11};
Physical Curve("wall") = {10:13};
Physical Curve("far") = {20:23};
Physical Surface("body") = {1:4};
