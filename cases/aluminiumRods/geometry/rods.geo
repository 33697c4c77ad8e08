// The pile of rods behind its gate. Lengths in metres.
width = 0.2;
height = 0.1;

Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, height, 0};
Point(4) = {0, height, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// The gate is the curve {2}: it has no name here, so it is free, as if it had been pulled away at once.
Physical Surface("rods") = {1};
Physical Curve("base") = {1};
Physical Curve("wall") = {4};
