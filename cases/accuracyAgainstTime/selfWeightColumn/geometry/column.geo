// A column 5 m wide and 50 m high, between smooth walls. Lengths in metres.
Point(1) = {0, 0, 0};
Point(2) = {5, 0, 0};
Point(3) = {5, 50, 0};
Point(4) = {0, 50, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
