// The soil column: 4 m wide, 8 m high. Lengths in metres.
width = 4;
height = 8;

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

// Names that the dictionaries use: the region in seedParticlesDict, the boundaries in boundaryConditions.
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 4};
Physical Curve("top") = {3};
