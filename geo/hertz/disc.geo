// Disc on a block: half of its lower half, in quadratic triangles with curved edges.
//
//   y = radius 6         top            5
//            +--------------------------+
//            |                          |
//            |           8            .'
//   y = box  + 7 --------+           .'
//     left   |           |        .-'       contact = side B of the joint: the arc 1-2-3,
//            |           |    _.-'             edges of length fine from 1 to 2, x = width, growing to 3, x = reach
//      y = 0 +--+--+----+'''4               7-8-4: for the mesh only
//            1  2  3    x = box
//          x = 0                     x = radius
//
// Physical groups: contact, top, left (curves), body (surface).

DefineConstant[ radius = {50, Name "Radius [mm]"} ];
DefineConstant[ width  = {8, Name "Width of the fine edges [mm]"} ];
DefineConstant[ reach  = {15.6, Name "Width of the contact curve, as far as that of the block faces it [mm]"} ];
DefineConstant[ box    = {20, Name "Width and height of the finer part [mm]"} ];
DefineConstant[ fine   = {0.2, Name "Size of the elements in the contact [mm]"} ];
DefineConstant[ around = {2, Name "Size of the elements around the finer part [mm]"} ];
DefineConstant[ coarse = {6, Name "Size of the elements at the top [mm]"} ];

Point(1) = {0, 0, 0, fine};
Point(2) = {width, radius - Sqrt(radius^2 - width^2), 0, fine};
Point(3) = {reach, radius - Sqrt(radius^2 - reach^2), 0, around / 2};
Point(4) = {box, radius - Sqrt(radius^2 - box^2), 0, around};
Point(5) = {radius, radius, 0, coarse};
Point(6) = {0, radius, 0, coarse};
Point(7) = {0, box, 0, around};
Point(8) = {box, box, 0, around};

Circle(1) = {1, 6, 2};
Circle(2) = {2, 6, 3};
Circle(3) = {3, 6, 4};
Circle(4) = {4, 6, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};
Line(8) = {4, 8};
Line(9) = {8, 7};
Curve Loop(1) = {1, 2, 3, 8, 9, 7};
Curve Loop(2) = {4, 5, 6, -9, -8};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

Mesh.ElementOrder = 2;

Physical Curve("contact") = {1, 2};
Physical Curve("top") = {5};
Physical Curve("left") = {6, 7};
Physical Surface("body") = {1, 2};
