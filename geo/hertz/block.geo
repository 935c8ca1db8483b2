// Disc on a block: half of the block, in quadratic triangles.
//
//          x = 0      x = box    x = side
//            1  2  3   4           5
//      y = 0 +--+--+---+-----------+     contact = side A of the joint: the line 1-2-3,
//            |         |           |         edges of length fine from 1 to 2, x = width, growing to 3, x = reach
//            + 9 ------+ 8         |     9-8-4: for the mesh only
//      left  |                     |
//            |         body        |
//            |                     |
//  -2 side   +---------------------+
//            7       bottom        6
//
// Physical groups: contact, bottom, left (curves), body (surface).

DefineConstant[ side   = {100, Name "Half of the side [mm]"} ];
DefineConstant[ width  = {8, Name "Width of the fine edges [mm]"} ];
DefineConstant[ reach  = {16, Name "Width of the contact curve [mm]"} ];
DefineConstant[ box    = {20, Name "Width and height of the finer part [mm]"} ];
DefineConstant[ fine   = {0.15, Name "Size of the elements in the contact [mm]"} ];
DefineConstant[ around = {2, Name "Size of the elements around the finer part [mm]"} ];
DefineConstant[ coarse = {25, Name "Size of the elements far off [mm]"} ];

Point(1) = {0, 0, 0, fine};
Point(2) = {width, 0, 0, fine};
Point(3) = {reach, 0, 0, around / 2};
Point(4) = {box, 0, 0, around};
Point(5) = {side, 0, 0, coarse};
Point(6) = {side, -2 * side, 0, coarse};
Point(7) = {0, -2 * side, 0, coarse};
Point(8) = {box, -box, 0, around};
Point(9) = {0, -box, 0, around};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 9};
Line(8) = {9, 1};
Line(9) = {9, 8};
Line(10) = {8, 4};
Curve Loop(1) = {9, 10, -3, -2, -1, -8};
Curve Loop(2) = {-6, -5, -4, -10, -9, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

Mesh.ElementOrder = 2;

Physical Curve("contact") = {1, 2};
Physical Curve("bottom") = {6};
Physical Curve("left") = {7, 8};
Physical Surface("body") = {1, 2};
