// A ring, inner radius 0.75 m, outer radius 1.25 m.
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1.25};
Disk(2) = {0, 0, 0, 0.75};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };

Physical Surface("ring") = {3};
