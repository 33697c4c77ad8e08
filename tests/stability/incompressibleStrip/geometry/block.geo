// A quarter of a block of 8 x 8 m, pressed by strips of 2 m on top and below; x = 0 and y = 0 are planes of symmetry.
Point(1) = {0, 0, 0};
Point(2) = {4, 0, 0};
Point(3) = {4, 4, 0};
Point(4) = {1, 4, 0};
Point(5) = {0, 4, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Surface("soil") = {1};
Physical Curve("strip") = {4};
