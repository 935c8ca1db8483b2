// Step block, upper part: its left end stands on the lower part, the rest hangs over.
//
//                          top
//   height  +------+------+------+------+------+
//           |      |      |      |      |      |
//     left  +------+---- body ---+------+------+  right, rows
//           |      |      |      |      |      |
//   y = 0   +------+------+------+------+------+
//                  bottom, edges: joined up to the end of the lower part, then free
//       x = start                        start + length
//
// Physical groups: bottom, right, top, left (curves), body (surface).

DefineConstant[ start  = {1.15, Name "Where it begins [m]"} ];
DefineConstant[ length = {1.2, Name "Length [m]"} ];
DefineConstant[ height = {0.6, Name "Height [m]"} ];
DefineConstant[ edges  = {17, Name "Edges along the bottom"} ];
DefineConstant[ rows   = {8, Name "Rows of elements over the height"} ];

Point(1) = {start, 0, 0};
Point(2) = {start + length, 0, 0};
Point(3) = {start + length, height, 0};
Point(4) = {start, height, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {1, 3} = edges + 1;
Transfinite Curve {2, 4} = rows + 1;
Transfinite Surface {1};
Recombine Surface {1};

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("body") = {1};
