// In plane strain: a block with its upper right corner cut out round. Lengths in metres.
length = 0.24;
height = 0.12;
radius = 0.06;
Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, height - radius, 0};
Point(4) = {length, height, 0};
Point(5) = {length - radius, height, 0};
Point(6) = {0, height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Circle(3) = {3, 4, 5};
Line(4) = {5, 6};
Line(5) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Surface("sand") = {1};
