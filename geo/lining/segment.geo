// One segment of the lining, between two angles.
//
//        outer = a side of the joint with the ground, edges
//       .-----------.
//      /   middle    \        start, end: sides of the joints between segments, rows
//     '--.    o    .--'
//          `-----´   inner
//
// Physical groups: inner, outer, start, end (curves), middle (point), body (surface).

DefineConstant[ radius    = {4.7, Name "Outer radius [m]"} ];
DefineConstant[ thickness = {0.4, Name "Thickness [m]"} ];
DefineConstant[ from  = {60, Name "Angle of the start [deg]"} ];
DefineConstant[ to    = {120, Name "Angle of the end [deg]"} ];
DefineConstant[ edges = {14, Name "Edges along the arc, even"} ];
DefineConstant[ rows  = {3, Name "Edges over the thickness"} ];
DefineConstant[ order = {2, Name "Order of the elements, 1 or 2"} ];

r = radius - thickness;
Point(1) = {0, 0, 0};
For k In {0:2}
  a = (from + k * (to - from) / 2) * Pi / 180;
  Point(10 + k) = {r * Cos(a), r * Sin(a), 0};
  Point(20 + k) = {radius * Cos(a), radius * Sin(a), 0};
EndFor
For k In {0:1}
  Circle(10 + k) = {10 + k, 1, 11 + k};
  Circle(20 + k) = {20 + k, 1, 21 + k};
EndFor
For k In {0:2}
  Line(30 + k) = {10 + k, 20 + k};
EndFor
For k In {0:1}
  Curve Loop(k + 1) = {30 + k, 20 + k, -(31 + k), -(10 + k)};
  Plane Surface(k + 1) = {k + 1};
  Transfinite Surface {k + 1};
  Recombine Surface {k + 1};
EndFor
Transfinite Curve {10, 11, 20, 21} = edges / 2 + 1;
Transfinite Curve {30:32} = rows + 1;
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;

Physical Point("middle") = {11};
Physical Curve("inner") = {10, 11};
Physical Curve("outer") = {20, 21};
Physical Curve("start") = {30};
Physical Curve("end") = {32};
Physical Surface("body") = {1, 2};
