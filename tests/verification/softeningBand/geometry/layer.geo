// A layer of clay, 2 m thick and one cell wide.
width = 0.1;
Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, 2, 0};
Point(4) = {0, 2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("clay") = {1};
Physical Curve("base") = {1};
