// One arm of a laminate: three layers in quadratic quadrilaterals, one mesh that is opened between them.
//
//                      high_crack     high_bond  34
//    height  4 +-----+------------+--------------+----------+----+ 54
//              |     |            |   layer3     |          |    |
//              +-----13-----------+--------------+----------+----+
//              |     |            |   layer2     |          |    |
//              +-----12-----------+--------------+----------+----+
//              |     |            |   layer1     |          |    |
//    bottom  1 +-----+------------+--------------+----------+----+ 51
//                    11 low_crack     low_bond   31         41
//    x =     -over   0          crack     crack + fine   length  + tail
//                3        far           edges        rest     1  edges
//
// Physical groups: low_crack, high_crack, low_bond, high_bond (curves), end_low (1), end_high (4), support (11), load_low (12),
// load_high (13), middle_low (31), middle_high (34, above 31), end_support (41), tail_low (51), tail_high (54) (points),
// layer1, layer2, layer3 (surfaces).

DefineConstant[ bottom = {0, Name "Height of the bottom of the arm [mm]"} ];
DefineConstant[ height = {2.1, Name "Height of the arm [mm]"} ];
DefineConstant[ over   = {5, Name "Overhang in front of the load [mm]"} ];
DefineConstant[ crack  = {48, Name "Length of the crack, from the load [mm]"} ];
DefineConstant[ fine   = {12, Name "Length of the fine mesh behind the tip [mm]"} ];
DefineConstant[ length = {65, Name "Length from the load to the end or the other support [mm]"} ];
DefineConstant[ tail   = {1, Name "Overhang behind that [mm]"} ];
DefineConstant[ edges  = {48, Name "Edges along the fine mesh"} ];
DefineConstant[ far    = {16, Name "Edges along the crack"} ];
DefineConstant[ rest   = {4, Name "Edges behind the fine mesh"} ];
DefineConstant[ order  = {2, Name "Order of the elements, 1 or 2"} ];

x[] = {-over, 0, crack, crack + fine, length, length + tail};
n[] = {3, far, edges, rest, 1};
For i In {0:5}
  For j In {0:3}
    Point(10 * i + j + 1) = {x[i], bottom + j * height / 3, 0};
  EndFor
EndFor
For i In {0:4}
  For j In {0:3}
    Line(100 + 10 * i + j) = {10 * i + j + 1, 10 * i + j + 11};
    // along the crack they get shorter towards its tip
    If (i == 1)
      Transfinite Curve {100 + 10 * i + j} = n[i] + 1 Using Progression 0.88;
    Else
      Transfinite Curve {100 + 10 * i + j} = n[i] + 1;
    EndIf
  EndFor
EndFor
For i In {0:5}
  For j In {0:2}
    Line(200 + 10 * i + j) = {10 * i + j + 1, 10 * i + j + 2};
    Transfinite Curve {200 + 10 * i + j} = 2;
  EndFor
EndFor
For j In {0:2}
  For i In {0:4}
    Curve Loop(300 + 10 * i + j) = {100 + 10 * i + j, 210 + 10 * i + j, -(101 + 10 * i + j), -(200 + 10 * i + j)};
    Plane Surface(300 + 10 * i + j) = {300 + 10 * i + j};
    Transfinite Surface {300 + 10 * i + j};
    Recombine Surface {300 + 10 * i + j};
  EndFor
  Physical Surface(Sprintf("layer%g", j + 1)) = {300 + j, 310 + j, 320 + j, 330 + j, 340 + j};
EndFor

Physical Curve("low_crack") = {100, 110};
Physical Curve("low_bond") = {120, 130, 140};
Physical Curve("high_crack") = {103, 113};
Physical Curve("high_bond") = {123, 133, 143};
Physical Point("end_low") = {1};
Physical Point("end_high") = {4};
Physical Point("tail_low") = {51};
Physical Point("tail_high") = {54};
Physical Point("load_low") = {12};
Physical Point("load_high") = {13};
Physical Point("support") = {11};
Physical Point("end_support") = {41};
Physical Point("middle_low") = {31};
Physical Point("middle_high") = {34};
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
