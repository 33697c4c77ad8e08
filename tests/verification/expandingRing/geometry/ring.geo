// A quarter of a ring, inner radius 0.4 m, outer radius 0.6 m.
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 0.6};
Disk(2) = {0, 0, 0, 0.4};
Rectangle(3) = {0, 0, 0, 1, 1};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
BooleanIntersection(5) = { Surface{4}; Delete; }{ Surface{3}; Delete; };
Physical Surface("ring") = {5};
