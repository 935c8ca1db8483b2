// Gravity dam, 80 m high, its base 60 m wide, its crest 5 m, its upstream face vertical.
//
//      5 m
//     .___.   crest
//     |    \
//     |     \       upstream: x = 0, from the heel up
//     |      \
//     |_______\     base, `edges` edges
//
// Physical groups: base, upstream, crest (curves), dam (surface).

DefineConstant[ edges = {60, Name "Edges along the base"} ];
DefineConstant[ size  = {4, Name "Edges at the crest [m]"} ];
DefineConstant[ order = {2, Name "Order of the elements, 1 or 2"} ];

h = 60 / edges;
Point(1) = {0, 0, 0, h};
Point(2) = {60, 0, 0, h};
Point(3) = {5, 80, 0, size};
Point(4) = {0, 80, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve {1} = edges + 1;

Physical Curve("base") = {1};
Physical Curve("crest") = {3};
Physical Curve("upstream") = {4};
Physical Surface("dam") = {1};
Mesh.ElementOrder = order;
