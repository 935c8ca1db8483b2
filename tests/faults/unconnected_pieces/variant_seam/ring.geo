// A square ring of two surfaces that share their line on the left, and whose points on the right are doubled.
lc = 0.4;
Point(1) = {0, 0, 0, lc}; Point(2) = {3, 0, 0, lc}; Point(3) = {3, 1, 0, lc}; Point(4) = {2, 1, 0, lc};
Point(5) = {1, 1, 0, lc}; Point(6) = {0, 1, 0, lc}; Point(7) = {1, 2, 0, lc}; Point(8) = {2, 2, 0, lc};
Point(9) = {2, 1, 0, lc}; Point(10) = {3, 1, 0, lc}; Point(11) = {3, 3, 0, lc}; Point(12) = {0, 3, 0, lc};
For i In {1:5}
  Line(i) = {i, i + 1};
EndFor
Line(6) = {6, 1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
Line(7) = {5, 7};
For i In {8:12}
  Line(i) = {i - 1, i};
EndFor
Line(13) = {12, 6};
Curve Loop(2) = {-5, 7:13}; Plane Surface(2) = {2};
Physical Curve("bottom") = {1}; Physical Curve("top") = {12}; Physical Surface("body") = {1, 2};
