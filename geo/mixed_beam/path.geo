// The way of the crack from the tip of the notch to the top, for both parts: ten pieces, curves 1 to 10.
//
//         + 11   top
//        /
//       + 10       Every point is where a crack without any traction, grown in steps of 6 mm from the notch of the elastic
//      /           beam, turns so that it goes on in mode I (K_II = 0, largest tangential stress). No parameter of the
//     + 9          joint enters. Lengths in mm; `near` is the size of the elements.
//   ...
//   + 1   tip of the notch

Point(1) = {75, 20, 0, near};
Point(2) = {77.1, 25.6, 0, near};
Point(3) = {79.4, 31.2, 0, near};
Point(4) = {81.8, 36.6, 0, near};
Point(5) = {84.3, 42.1, 0, near};
Point(6) = {86.6, 47.6, 0, near};
Point(7) = {88.8, 53.2, 0, near};
Point(8) = {90.8, 58.9, 0, near};
Point(9) = {92.6, 64.6, 0, near};
Point(10) = {94.0, 70.5, 0, near};
Point(11) = {95.2, 80, 0, near};
For piece In {1 : 10}
  Line(piece) = {piece, piece + 1};
EndFor
